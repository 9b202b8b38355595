#pragma once

#include <openvdb/util/NullInterrupter.h>

#include "solidnoise/core/progress.h"

namespace solidnoise {

// Lets OpenVDB's tools be cancelled: they ask this now and then, and then return early, with a grid that
// means nothing. Ask the Progress again afterwards.
class Interrupter final : public openvdb::util::NullInterrupter {
 public:
  explicit Interrupter(Progress* progress) : progress_(progress) {}
  bool wasInterrupted(int = -1) override { return progress_ != nullptr && progress_->cancelled(); }

 private:
  Progress* progress_;
};

}  // namespace solidnoise
