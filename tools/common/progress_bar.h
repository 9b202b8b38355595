#pragma once

#include <chrono>
#include <string>

namespace solidnoise {

// One line on a terminal's standard error, redrawn at most ten times a second; nothing where standard error
// is not a terminal. The line is wiped when the bar goes.
class ProgressBar {
 public:
  enum class Visibility { if_terminal, hidden };

  explicit ProgressBar(Visibility visibility);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // `fraction` of the task done, 0 to 1. Call from one thread at a time.
  void show(const std::string& task, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_ = false;
  bool drawn_ = false;
  std::string task_;
  Clock::time_point last_drawn_;
};

}  // namespace solidnoise
