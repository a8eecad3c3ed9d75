#include "app/cli/support/resource_folder.h"

#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.h"

namespace sinew {
namespace {

bool isResourceFolder(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::exists(folder / "skeleton" / "reference_skeleton.json", error);
}

}  // namespace

std::filesystem::path findResourceFolder(const std::filesystem::path& executable,
                                         const std::filesystem::path& given) {
  std::vector<std::filesystem::path> places;
  if (!given.empty()) {
    places = {given};
  } else if (const char* set = std::getenv("SINEW_RESOURCE_DIR"); set && *set) {
    places = {set};
  } else {
    const auto prefix = executable.parent_path().parent_path();
    places = {prefix / "resources", prefix / "share" / "sinew" / "resources"};
  }
  std::string tried;
  for (const auto& place : places) {
    if (isResourceFolder(place)) return std::filesystem::absolute(place);
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  throw InputError{{"resources", "", "a folder with skeleton/reference_skeleton.json", "none in " + tried}};
}

std::filesystem::path executablePath() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

}  // namespace sinew
