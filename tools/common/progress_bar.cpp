#include "common/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace solidnoise {
namespace {

constexpr std::chrono::milliseconds kShortestInterval{100};
constexpr int kBarWidth = 32;  // characters

void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressBar::ProgressBar(Visibility visibility)
    : visible_(visibility == Visibility::if_terminal && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (drawn_) put("\r\x1b[K");
}

void ProgressBar::show(const std::string& task, double fraction) {
  if (!visible_) return;
  const Clock::time_point now = Clock::now();
  if (drawn_ && task == task_ && now - last_drawn_ < kShortestInterval) return;
  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(done * kBarWidth);
  put(fmt::format("\r\x1b[K{:<10} [{}{}] {:3.0f} %", task, std::string(static_cast<std::size_t>(filled), '#'),
                  std::string(static_cast<std::size_t>(kBarWidth - filled), '.'), 100.0 * done));
  drawn_ = true;
  task_ = task;
  last_drawn_ = now;
}

}  // namespace solidnoise
