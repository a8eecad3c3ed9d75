#pragma once
#include <filesystem>

namespace sinew {

/// Folder of the reference data: `given` if not empty, else SINEW_RESOURCE_DIR, else ../resources or
/// ../share/sinew/resources beside `executable`. @throws InputError naming all places if there is none.
std::filesystem::path findResourceFolder(const std::filesystem::path& executable, const std::filesystem::path& given);

/// Where this program is.
std::filesystem::path executablePath();

}  // namespace sinew
