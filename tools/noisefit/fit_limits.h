#pragma once

#include <cstdint>

#include "common/flag_set.h"

namespace solidnoise {

// What a fit may take.
struct FitLimits {
  std::uint64_t max_memory = 0;  // bytes; 0: what the machine has available
  double max_time = 0.0;         // seconds; 0: any

  // Throws std::runtime_error if a fit of so many samples, those of all channels and exemplars, may take
  // more.
  void check(double samples) const;
};

void declare_limits(FlagSet& flags, FitLimits& limits);

}  // namespace solidnoise
