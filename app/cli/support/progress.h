#pragma once
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

namespace sinew {

/// Progress and warnings for a person, on one stream: a bar that is redrawn on a terminal, plain lines otherwise
/// (a line when the work changes its name), nothing if quiet. Safe to call from any thread.
class Progress {
 public:
  enum class Style { Bar, Lines, Quiet };
  explicit Progress(std::FILE* stream, Style style) : stream_{stream}, style_{style} {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  /// How far `work` is, 0-1. At most 20 redraws a second.
  void report(double fraction, std::string_view work);
  /// A line of its own: a warning, a note. Shown unless quiet.
  void line(const std::string& text);
  /// Takes the bar away, so that other output can follow.
  void clear();

 private:
  void clearLocked();

  std::mutex mutex_;
  std::FILE* stream_;
  Style style_;
  bool bar_shown_ = false;
  std::string last_work_;
  std::chrono::steady_clock::time_point last_drawn_{};
};

}  // namespace sinew
