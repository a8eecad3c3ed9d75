#include "clinical/pipeline/resource_hash.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "core/file.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

/// What was read of one file, and what it looked like then.
struct Known {
  std::uintmax_t bytes = 0;
  fs::file_time_type written;
  std::string sha256;
};

std::string fileHash(const fs::path& file) {
  static std::mutex mutex;
  static std::map<fs::path, Known> known;  // a memory of contents, not a state: equal files give equal hashes
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  if (error) return sha256("");
  const auto written = fs::last_write_time(file, error);
  if (error) return sha256("");
  const std::scoped_lock lock{mutex};
  Known& k = known[file];
  if (k.sha256.empty() || k.bytes != bytes || k.written != written) {
    try {
      k = {bytes, written, sha256OfFile(file)};
    } catch (const InputError&) {  // unreadable: as if it were not there; the stage that needs it says why
      return sha256("");
    }
  }
  return k.sha256;
}

std::string folderHash(const fs::path& folder) {
  std::vector<std::string> lines;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator{
           folder, fs::directory_options::follow_directory_symlink | fs::directory_options::skip_permission_denied,
           error})
    if (entry.is_regular_file(error))
      lines.push_back(entry.path().lexically_relative(folder).generic_string() + ' ' + fileHash(entry.path()) + '\n');
  std::ranges::sort(lines);
  std::string all;
  for (const auto& line : lines) all += line;
  return sha256(all);
}

}  // namespace

std::string resourceHash(const fs::path& resource_dir, std::string_view relative_path) {
  std::error_code error;
  const auto path = resource_dir / relative_path;
  return fs::is_directory(path, error) ? folderHash(path) : fileHash(path);
}

}  // namespace sinew
