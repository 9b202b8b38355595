#include "common/frames.h"

#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {

void declare_frame_flags(FlagSet& flags, const std::string& example, std::vector<int>& frames, double& fps) {
  flags.text("--frames", "A-B[xSTEP]", "Make these frames; outputs are named such as " + example,
             [&](const std::string& text) { frames = parse_frames("--frames", text); });
  flags.number("--fps", "RATE", "With --frames: frames per unit of time; frame n is at n / RATE (default 24)",
               [&](double value) {
                 require_in_range("--fps", value, 1e-6, 1e6, "frames per unit of time");
                 fps = value;
               });
}

double frame_time(int frame, double fps, double loop) {
  constexpr double kTolerance = 1e-6;
  constexpr double kMost = 1e9;
  if (loop == 0.0) return frame / fps;
  const double frames = loop * fps;
  const double whole = std::round(frames);
  if (whole < 1.0 || whole > kMost || std::abs(frames - whole) > kTolerance * whole) {
    throw UsageError(
        fmt::format("--loop is {}, which at {} frames per unit of time is {:.6g} frames; it must be a whole "
                    "number of them",
                    loop, fps, frames));
  }
  return frame % static_cast<int>(whole) / fps;
}

std::string name_loop(const FlagSet& flags, const std::string& message) {
  constexpr std::string_view kPeriod = "period is ";
  constexpr std::string_view kAxis = " along t;";
  const std::size_t axis = message.find(kAxis);
  if (!flags.given("--loop") || !message.starts_with(kPeriod) || axis == std::string::npos) return message;
  const std::string value = message.substr(kPeriod.size(), axis - kPeriod.size());
  return fmt::format("loop is {};{}", value, message.substr(axis + kAxis.size()));
}

void refuse_frame_number(const std::string& flag, const std::string& path) {
  if (!has_frame_number(path)) return;
  throw UsageError(fmt::format("{} is {}, which has a place for the number of a frame; give --frames", flag,
                               printable(path)));
}

}  // namespace solidnoise
