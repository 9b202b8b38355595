#include "common/stage_times.h"

#include <algorithm>
#include <ctime>
#include <utility>

#include <fmt/format.h>

namespace solidnoise {
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
