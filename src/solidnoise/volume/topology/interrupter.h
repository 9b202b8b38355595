#pragma once

#include <algorithm>
#include <cstdint>

#include <openvdb/util/NullInterrupter.h>

#include "solidnoise/core/progress.h"

namespace solidnoise {

// Lets OpenVDB's tools be cancelled: they ask this now and then, and then return early, with a grid that
// means nothing. Ask the Progress again afterwards. Where it is known how often they begin something,
// progress counts that.
class Interrupter final : public openvdb::util::NullInterrupter {
 public:
  explicit Interrupter(Progress* progress, std::uint64_t steps = 0) : progress_(progress), steps_(steps) {}
  void start(const char* = nullptr) override {
    if (progress_ != nullptr && steps_ > 0) progress_->advance(std::min(begun_++, steps_), steps_);
  }
  // As the type that OpenVDB's tools are compiled for in its library; others compile them anew, for a minute.
  openvdb::util::NullInterrupter& base() { return *this; }
  bool wasInterrupted(int = -1) override { return progress_ != nullptr && progress_->cancelled(); }

 private:
  Progress* progress_;
  std::uint64_t steps_;
  std::uint64_t begun_ = 0;
};

}  // namespace solidnoise
