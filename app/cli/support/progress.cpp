#include "app/cli/support/progress.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr int kBarWidth = 24;
constexpr std::size_t kMaxLabel = 48;
constexpr std::chrono::milliseconds kRedrawInterval{50};

}  // namespace

void Progress::report(double fraction, std::string_view work) {
  if (style_ == Style::Quiet) return;
  const std::scoped_lock lock{mutex_};
  if (style_ == Style::Lines) {
    if (work == last_work_ || fraction >= 1) return;  // the end of a step is no news: its result follows
    last_work_ = work;
    std::fprintf(stream_, "%s\n", last_work_.c_str());
    std::fflush(stream_);
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (bar_shown_ && now - last_drawn_ < kRedrawInterval) return;
  last_drawn_ = now;
  bar_shown_ = true;
  const double share = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const int full = static_cast<int>(std::lround(share * kBarWidth));
  const std::string bar =
      std::string(static_cast<std::size_t>(full), '#') + std::string(static_cast<std::size_t>(kBarWidth - full), '.');
  std::fprintf(stream_, "\r\033[K[%s] %3.0f %%  %.*s", bar.c_str(), 100 * share,
               static_cast<int>(std::min(work.size(), kMaxLabel)), work.data());
  std::fflush(stream_);
}

void Progress::line(const std::string& text) {
  if (style_ == Style::Quiet) return;
  const std::scoped_lock lock{mutex_};
  clearLocked();
  std::fprintf(stream_, "%s\n", text.c_str());
  std::fflush(stream_);
}

void Progress::clear() {
  const std::scoped_lock lock{mutex_};
  clearLocked();
}

void Progress::clearLocked() {
  if (!bar_shown_) return;
  std::fputs("\r\033[K", stream_);
  std::fflush(stream_);
  bar_shown_ = false;
}

}  // namespace sinew
