#include "core/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/error.h"

namespace sinew {
namespace {

/// Closes a POSIX descriptor on every way out.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_{fd} {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void throwErrno(const std::filesystem::path& file, const std::string& what) {
  throw InputError{file.string() + ": " + what + ": " + std::strerror(errno)};
}

/// Who may read a file: as before if it exists, else as the user's umask says; a case holds a patient's name.
mode_t modeFor(const std::filesystem::path& file) {
  struct stat present {};
  if (::stat(file.c_str(), &present) == 0) return present.st_mode & 0777;
  const mode_t mask = ::umask(077);  // it can only be read by setting it; for that moment the strictest
  ::umask(mask);
  return 0666 & ~mask;
}

void writeAll(int fd, std::string_view content, const std::filesystem::path& file) {
  while (!content.empty()) {
    const auto written = ::write(fd, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throwErrno(file, "cannot be written");
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

std::string readFile(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw InputError{{file.string(), "", "a file", "a folder"}};
  std::ifstream in{file, std::ios::binary};
  if (!in) throw InputError{{file.string(), "", "a file that can be read", std::strerror(errno)}};
  const auto size = std::filesystem::file_size(file, error);
  if (!error && size > max_bytes)
    throw InputError{
        {file.string(), "size", "at most " + std::to_string(max_bytes) + " bytes", std::to_string(size)}};
  std::ostringstream content;
  content << in.rdbuf();
  std::string text = std::move(content).str();
  if (!error && std::filesystem::is_regular_file(file) && text.size() < size)  // a disk or network that failed midway
    throw InputError{{file.string(), "content", std::to_string(size) + " bytes", std::to_string(text.size())}};
  return text;
}

void writeFileAtomically(const std::filesystem::path& file, std::string_view content) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path{"."};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::string temporary = (folder / ("." + file.filename().string() + ".XXXXXX")).string();
  const Descriptor out{::mkstemp(temporary.data())};
  if (out.get() < 0) throwErrno(file, "cannot be created");
  try {
    writeAll(out.get(), content, file);
    ::fchmod(out.get(), modeFor(file));
    if (::fsync(out.get()) != 0) throwErrno(file, "cannot be flushed");
    if (::rename(temporary.c_str(), file.c_str()) != 0) throwErrno(file, "cannot be replaced");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  const Descriptor directory{::open(folder.c_str(), O_RDONLY | O_DIRECTORY)};
  if (directory.get() >= 0) ::fsync(directory.get());
}

std::string sha256(std::string_view content) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  require(EVP_Digest(content.data(), content.size(), digest.data(), &size, EVP_sha256(), nullptr) == 1,
          "SHA-256 is available");
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += kHex[digest[i] >> 4];
    text += kHex[digest[i] & 15];
  }
  return text;
}

std::string sha256OfFile(const std::filesystem::path& file) {
  return sha256(readFile(file));
}

}  // namespace sinew
