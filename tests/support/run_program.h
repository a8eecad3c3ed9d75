#pragma once
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace sinew::test {

/// What a program printed and answered.
struct ProgramResult {
  int status = -1;  ///< exit status; -signal if it was ended by one
  std::string out, err;
};

/// A program that was started and not yet waited for.
class Program {
 public:
  /// Runs `arguments[0]`; its streams go to files. Variables DISPLAY and WAYLAND_DISPLAY are taken away: no screen.
  explicit Program(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const std::string out = (folder_ / "out").string(), err = (folder_ / "err").string();
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  pid_t pid() const { return pid_; }
  std::string errSoFar() const { return content("err"); }

  ProgramResult wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content("out"), content("err")};
  }

 private:
  std::string content(const std::string& name) const {
    std::ifstream in{folder_ / name, std::ios::binary};
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  TemporaryFolder folder_;
  pid_t pid_ = -1;
};

inline ProgramResult runProgram(const std::vector<std::string>& arguments) {
  return Program{arguments}.wait();
}

}  // namespace sinew::test
