#include "app/scene/offscreen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkSSAOPass.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "app/scene/glew_on_egl.h"
#include "core/error.h"

namespace sinew {
namespace {

[[noreturn]] void missing(const std::string& what) {
  throw InputError{{"offscreen rendering", "OpenGL", "EGL with OpenGL 3.2 (Debian: libegl1, libgl1-mesa-dri)", what}};
}

/// A current OpenGL context without any surface, for the life of the object.
class EglContext {
 public:
  EglContext() {
    const auto platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!platform_display) missing("EGL without platform displays");
    display_ = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display_, &major, &minor)) missing("no surfaceless EGL display");
    eglBindAPI(EGL_OPENGL_API);
    const EGLint config_wish[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    if (!eglChooseConfig(display_, config_wish, &config, 1, &count) || count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLint wish[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, wish);
    if (context_ == EGL_NO_CONTEXT) missing("no OpenGL 3.2 core context");
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      missing("context cannot be made current");
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglReleaseThread();  // the display stays: other threads may hold contexts of it
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

template <class T>
void answer(vtkRenderWindow* window, unsigned long event, void (*reply)(T&)) {
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(reinterpret_cast<void*>(reply));
  command->SetCallback([](vtkObject*, unsigned long, void* client, void* data) {
    reinterpret_cast<void (*)(T&)>(client)(*static_cast<T*>(data));
  });
  window->AddObserver(event, command);
}

void addAmbientOcclusion(vtkRenderer& renderer) {
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetDelegatePass(steps);
  occlusion->SetRadius(0.05);  // m: hollows of the size of a joint
  occlusion->SetBias(0.004);
  occlusion->SetKernelSize(32);
  occlusion->BlurOn();
  static_cast<vtkOpenGLRenderer&>(renderer).SetPass(occlusion);
}

/// Mean of factor x factor pixels; VTK's rows run from the bottom.
RgbImage reduced(const std::uint8_t* rgb, int width_px, int height_px, int factor) {
  RgbImage image{width_px, height_px, {}};
  image.rgb.resize(std::size_t(3) * width_px * height_px);
  const int row = width_px * factor, n = factor * factor;
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u)
      for (int k = 0; k < 3; ++k) {
        int sum = 0;
        for (int j = 0; j < factor; ++j)
          for (int i = 0; i < factor; ++i)
            sum += rgb[3 * (std::size_t((height_px - 1 - v) * factor + j) * row + u * factor + i) + k];
        image.rgb[3 * (std::size_t(v) * width_px + u) + k] = std::uint8_t((sum + n / 2) / n);
      }
  return image;
}

RgbImage renderHere(int width_px, int height_px, const std::function<void(vtkRenderer&)>& compose,
                    const OffscreenOptions& options) {
  const int factor = std::clamp(options.supersampling, 1, 4);
  EglContext context;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetOwnContext(0);
  window->SetFrameBlitModeToNoBlit();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width_px * factor, height_px * factor);
  answer<bool>(window, vtkCommand::WindowIsCurrentEvent, [](bool& current) { current = true; });
  answer<int>(window, vtkCommand::WindowSupportsOpenGLEvent, [](int& supported) { supported = 1; });
  window->SetReadyForRendering(true);

  vtkNew<vtkOpenGLRenderer> renderer;
  window->AddRenderer(renderer);
  RgbImage image;
  try {
    compose(*renderer);
    if (options.ambient_occlusion) addAmbientOcclusion(*renderer);
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    static_cast<vtkRenderWindow*>(window)->GetPixelData(0, 0, width_px * factor - 1, height_px * factor - 1, 0,
                                                        pixels.Get());
    image = reduced(pixels->GetPointer(0), width_px, height_px, factor);
  } catch (...) {
    window->Finalize();
    throw;
  }
  window->Finalize();
  return image;
}

}  // namespace

RgbImage renderOffscreen(int width_px, int height_px, const std::function<void(vtkRenderer&)>& compose,
                         const OffscreenOptions& options) {
  require(width_px > 0 && height_px > 0, "renderOffscreen: the picture has no pixels");
  static std::mutex one_at_a_time;
  const std::scoped_lock lock{one_at_a_time};
  acceptEglContexts();
  RgbImage image;
  std::exception_ptr failure;
  std::jthread{[&] {
    try {
      image = renderHere(width_px, height_px, compose, options);
    } catch (...) {
      failure = std::current_exception();
    }
  }}.join();
  if (failure) std::rethrow_exception(failure);
  return image;
}

}  // namespace sinew
