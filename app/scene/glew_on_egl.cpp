#include "app/scene/glew_on_egl.h"

#include <dlfcn.h>

extern "C" __attribute__((visibility("default"))) unsigned glewInit();

extern "C" unsigned glewInit() {
  using Init = unsigned (*)();
  static const auto system_init = reinterpret_cast<Init>(dlsym(RTLD_NEXT, "glewInit"));
  constexpr unsigned kOk = 0, kError = 1, kNoXDisplay = 4;
  const unsigned result = system_init ? system_init() : kError;
  return result == kNoXDisplay ? kOk : result;
}

namespace sinew {

void acceptEglContexts() {}

}  // namespace sinew
