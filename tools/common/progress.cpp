#include "common/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "common/run_tool.h"

namespace solidnoise {
namespace {

void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string time_left(double seconds, double done) {
  constexpr double kWhile = 1.0;
  constexpr double kEnough = 0.02;
  if (seconds < kWhile || done < kEnough) return {};
  const double left = seconds * (1.0 - done) / done;
  return left < 100.0 ? fmt::format(", {:.0f} s left", std::ceil(left))
                      : fmt::format(", {:.0f} min left", std::ceil(left / 60.0));
}

TaskProgress::TaskProgress(Visibility visibility)
    : visible_(visibility == Visibility::if_terminal && isatty(STDERR_FILENO) != 0),
      logs_(visibility == Visibility::in_log),
      began_(Clock::now()),
      last_shown_(began_) {}

TaskProgress::~TaskProgress() {
  if (drawn_) put("\r\x1b[K");
}

void TaskProgress::begin(const std::string& task, std::function<void()> done) {
  task_ = task;
  done_ = std::move(done);
  began_ = Clock::now();
  if (!logs_) last_shown_ = {};
  logged_ = 0;
}

void TaskProgress::advance(std::uint64_t done, std::uint64_t total) {
  if (done == total && done_) done_();
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || total == 0) return;
  const double fraction = std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0);
  if (logs_) log(fraction);
  if (visible_) draw(fraction);
}

bool TaskProgress::cancelled() {
  return interrupt_signal() != 0;
}

void TaskProgress::draw(double fraction) {
  constexpr std::chrono::milliseconds kShortestInterval{100};
  constexpr int kWidth = 32;  // characters
  const Clock::time_point now = Clock::now();
  if (now - last_shown_ < kShortestInterval) return;
  const int filled = static_cast<int>(fraction * kWidth);
  put(fmt::format("\r\x1b[K{:<10} [{:#<{}}{:.<{}}] {:3.0f} %{}", task_, "", filled, "", kWidth - filled,
                  100.0 * fraction,
                  time_left(std::chrono::duration<double>(now - began_).count(), fraction)));
  drawn_ = true;
  last_shown_ = now;
}

void TaskProgress::log(double fraction) {
  constexpr int kStep = 10;
  constexpr std::chrono::seconds kLogInterval{10};
  const Clock::time_point now = Clock::now();
  const int percent = static_cast<int>(100.0 * fraction);
  if (percent < logged_ + kStep || now - last_shown_ < kLogInterval) return;
  logged_ = percent - percent % kStep;
  last_shown_ = now;
  put(fmt::format("{} {} %\n", task_, logged_));
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

}  // namespace solidnoise
