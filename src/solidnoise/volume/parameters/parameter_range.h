#pragma once

#include <string_view>

#include "solidnoise/noise/kernel/kernel_family.h"

namespace solidnoise {

// Which values of a parameter are allowed, with words for it.
struct ParameterRange {
  double lowest = 0.0;
  double highest = 0.0;
  std::string_view allowed;
  bool without_lowest = false;

  // In single precision, in which grids have them. False for not-a-number.
  bool allows(double value) const {
    const auto v = static_cast<float>(value);
    const auto lower = static_cast<float>(lowest);
    return (without_lowest ? v > lower : v >= lower) && v <= static_cast<float>(highest);
  }
};

// Limits at which lengths and kernels stay finite in single precision.
inline constexpr ParameterRange kFrequencyRange{0.0, 1e12, "greater than 0 (cycles per world unit)", true};
inline constexpr ParameterRange kBandwidthRange{KernelFamily::kLeastBandwidth, KernelFamily::kMostBandwidth,
                                                "between 0.1 and 4 (octaves)"};
inline constexpr ParameterRange kMagnitudeRange{0.0, 1e12, "at least 0 (sigmas)"};

}  // namespace solidnoise
