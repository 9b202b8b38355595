#include "noisefit/fit_limits.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/memory.h"
#include "common/parse_value.h"
#include "solidnoise/core/check.h"

namespace solidnoise {

// Measured with pictures of 64^2 to 1024^2 pixels and boxes of 32^3 to 96^3 voxels: 105 to 120 bytes, and 15
// to 35 microseconds of one core, most where the spectrum is rich.
void FitLimits::check(double samples) const {
  constexpr double kProgramBytes = 140.0 * 0x1p20;  // most of it OpenImageIO
  constexpr double kBytesPerSample = 128.0;
  constexpr double kSecondsPerSample = 35e-6;
  const double bytes = kProgramBytes + kBytesPerSample * samples;
  const std::uint64_t limit = max_memory != 0 ? max_memory : available_memory();
  if (limit != 0 && bytes > static_cast<double>(limit)) {
    throw std::runtime_error(fmt::format("{:.0f} samples may need {}, --max-memory allows {}{}", samples,
                                         format_bytes(static_cast<std::uint64_t>(std::min(bytes, 0x1.0p63))),
                                         format_bytes(limit), max_memory != 0 ? "" : ", what is available"));
  }
  const double seconds = kSecondsPerSample * samples;
  if (max_time > 0.0 && seconds > max_time) {
    throw std::runtime_error(fmt::format("{:.0f} samples may take {:.3g} seconds, --max-time allows {:.3g}",
                                         samples, seconds, max_time));
  }
}

void declare_limits(FlagSet& flags, FitLimits& limits) {
  flags.text("--max-memory", "SIZE", "Refuse to need more than this, such as 8G (default: what is available)",
             [&](const std::string& text) { limits.max_memory = parse_bytes("--max-memory", text); });
  flags.number("--max-time", "SECONDS", "Refuse what may take longer (default: any)", [&](double value) {
    require_positive("max_time", value, "seconds");
    limits.max_time = value;
  });
}

}  // namespace solidnoise
