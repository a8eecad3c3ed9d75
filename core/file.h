#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace sinew {

/// Whole content of a file. @throws InputError if it cannot be read or is larger than `max_bytes`.
std::string readFile(const std::filesystem::path& file, std::uintmax_t max_bytes = std::uintmax_t{1} << 30);

/// Replaces `file` by `content` so that a reader, or a crash at any moment, sees the old or the new content, whole:
/// temporary file in the same folder, fsync, rename, fsync of the folder. @throws InputError if that fails.
void writeFileAtomically(const std::filesystem::path& file, std::string_view content);

/// SHA-256 in lower-case hexadecimal.
std::string sha256(std::string_view content);
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace sinew
