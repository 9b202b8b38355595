#include "common/progress.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "common/run_tool.h"

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

namespace {

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

StageTimes::StageTimes() : since_(Clock::now()), processor_since_(processor_seconds()) {
  stages_.push_back({"start", processor_since_, processor_since_});
}

void StageTimes::begin(const std::string& stage) {
  const std::lock_guard lock(mutex_);
  count_until_now();
  const auto found =
      std::find_if(stages_.begin(), stages_.end(), [&](const Stage& other) { return other.name == stage; });
  current_ = static_cast<std::size_t>(found - stages_.begin());
  if (found == stages_.end()) stages_.push_back({stage, 0.0, 0.0});
}

std::string StageTimes::report() {
  const std::lock_guard lock(mutex_);
  count_until_now();
  Stage all{"all", 0.0, 0.0};
  for (const Stage& stage : stages_) {
    all.wall += stage.wall;
    all.processor += stage.processor;
  }
  std::string text;
  const auto add = [&](const Stage& stage) {
    text += fmt::format("{:<10} {:9.3f} s {:9.3f} s of processor {:4.0f} %\n", stage.name, stage.wall,
                        stage.processor, all.wall > 0.0 ? 100.0 * stage.wall / all.wall : 0.0);
  };
  for (const Stage& stage : stages_) add(stage);
  add(all);
  return text;
}

void StageTimes::count_until_now() {
  const Clock::time_point now = Clock::now();
  const double processor = processor_seconds();
  stages_[current_].wall += std::chrono::duration<double>(now - since_).count();
  stages_[current_].processor += processor - processor_since_;
  since_ = now;
  processor_since_ = processor;
}

void TaskProgress::begin(const std::string& task, std::function<void()> done) {
  task_ = task;
  done_ = std::move(done);
}

void TaskProgress::advance(std::uint64_t done, std::uint64_t total) {
  if (done == total && done_) done_();
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || total == 0) return;
  bar_.show(task_, static_cast<double>(done) / static_cast<double>(total));
}

bool TaskProgress::cancelled() {
  return interrupt_signal() != 0;
}

}  // namespace solidnoise
