#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace sinew {

/// SHA-256 of a file of the resources, or of a folder: of the names and contents of all files below it. A file that
/// is not there has the hash of nothing, so that its coming or going is a change like any other. A file is read again
/// only if its size or time changed since the process read it. From any thread.
std::string resourceHash(const std::filesystem::path& resource_dir, std::string_view relative_path);

}  // namespace sinew
