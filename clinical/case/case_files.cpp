#include <algorithm>
#include <fstream>

#include "clinical/case/case_io.h"
#include "core/file.h"

namespace sinew {
namespace {

constexpr std::string_view kExpectation = "a path inside the case folder";

/// A symbolic link must not lead out of the folder.
void refuseLinkOutOf(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto base = std::filesystem::weakly_canonical(folder, error);
  const auto target = std::filesystem::weakly_canonical(file, error);
  if (std::mismatch(base.begin(), base.end(), target.begin(), target.end()).first != base.end())
    throw InputError{{file.string(), "", std::string{kExpectation}, "a link that leads out of it"}};
}

}  // namespace

bool staysInFolder(const std::string& relative_path) {
  const std::filesystem::path path{relative_path};
  if (path.empty() || path.is_absolute() || !path.has_filename()) return false;
  if (relative_path.find('\\') != std::string::npos || relative_path.find('\0') != std::string::npos) return false;
  return std::ranges::none_of(path, [](const auto& part) { return part == ".." || part == "."; });
}

FileReference importFile(const std::filesystem::path& source, const std::filesystem::path& folder,
                         const std::string& relative_path) {
  if (!staysInFolder(relative_path)) throw InputError{{relative_path, "", std::string{kExpectation}, "another path"}};
  const std::string content = readFile(source);
  writeFileAtomically(folder / relative_path, content);
  return {relative_path, sha256(content)};
}

std::string imageExtension(const std::filesystem::path& source) {
  std::string head(132, '\0');
  std::ifstream in{source, std::ios::binary};
  in.read(head.data(), std::streamsize(head.size()));
  if (head.substr(128) == "DICM") return ".dcm";  // first: its preamble may be the beginning of a TIFF
  if (head.starts_with("\x89PNG")) return ".png";
  if (head.starts_with(std::string_view{"II*\0", 4}) || head.starts_with(std::string_view{"MM\0*", 4})) return ".tif";
  return ".dcm";
}

std::filesystem::path checkedFile(const FileReference& reference, const std::filesystem::path& folder) {
  const auto file = folder / reference.path;
  if (!staysInFolder(reference.path))
    throw InputError{{file.string(), "", std::string{kExpectation}, "another path"}};
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError{{file.string(), "", "a file of the case", error ? error.message() : "nothing"}};
  refuseLinkOutOf(folder, file);
  const std::string found = sha256OfFile(file);
  if (found != reference.sha256)
    throw InputError{{file.string(), "content", "SHA-256 " + reference.sha256.substr(0, 12) + "... as in case.json",
                      found.substr(0, 12) + "...: the file was changed or damaged"}};
  return file;
}

bool isUndamaged(const FileReference& reference, const std::filesystem::path& folder) {
  try {
    checkedFile(reference, folder);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::filesystem::path resultFile(const std::string& relative_path, const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError{{folder.string(), "", "the case folder", error ? error.message() : "nothing"}};
  const auto file = folder / relative_path;
  refuseLinkOutOf(folder, file);
  return file;
}

}  // namespace sinew
