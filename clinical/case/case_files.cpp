#include <algorithm>

#include "clinical/case/case_io.h"
#include "core/file.h"

namespace sinew {
namespace {

constexpr std::string_view kExpectation = "a path inside the case folder";

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

std::filesystem::path checkedFile(const FileReference& reference, const std::filesystem::path& folder) {
  const auto file = folder / reference.path;
  if (!staysInFolder(reference.path))
    throw InputError{{file.string(), "", std::string{kExpectation}, "another path"}};
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError{{file.string(), "", "a file of the case", "nothing"}};
  // A symbolic link must not lead out of the folder either.
  const auto base = std::filesystem::weakly_canonical(folder, error);
  const auto target = std::filesystem::weakly_canonical(file, error);
  if (std::mismatch(base.begin(), base.end(), target.begin(), target.end()).first != base.end())
    throw InputError{{file.string(), "", std::string{kExpectation}, "a link that leads out of it"}};
  const std::string found = sha256OfFile(file);
  if (found != reference.sha256)
    throw InputError{{file.string(), "content", "SHA-256 " + reference.sha256.substr(0, 12) + "... as in case.json",
                      found.substr(0, 12) + "...: the file was changed or damaged"}};
  return file;
}

}  // namespace sinew
