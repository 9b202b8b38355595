#include "common/frame_curve.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/core/printable.h"

namespace solidnoise {

bool is_curve(const std::string& text) {
  return text.find(':') != std::string::npos;
}

FrameCurve::FrameCurve(const std::string& flag, const std::string& text) {
  const auto refuse = [&] {
    throw UsageError(fmt::format(
        "{} is {}; it must be a number, or one for each of some frames, from 0 on and in their order, such "
        "as 0:1,24:3",
        flag, printable(text)));
  };
  std::istringstream keys(text + ',');
  for (std::string key; std::getline(keys, key, ',');) {
    const std::size_t colon = key.find(':');
    if (colon == std::string::npos || key.find(':', colon + 1) != std::string::npos) refuse();
    try {
      const int frame = parse_integer(flag, key.substr(0, colon));
      const double value = parse_number(flag, key.substr(colon + 1));
      if (frame < 0 || (!keys_.empty() && frame <= keys_.back().first)) refuse();
      keys_.emplace_back(frame, value);
    } catch (const UsageError&) {
      refuse();
    }
  }
}

double FrameCurve::at(int frame) const {
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), frame,
                                      [](int wanted, const auto& key) { return wanted < key.first; });
  if (after == keys_.begin()) return after->second;
  const auto& [from, at_from] = *(after - 1);
  if (after == keys_.end() || frame == from) return at_from;
  const double part = static_cast<double>(frame - from) / (after->first - from);
  return at_from * (1.0 - part) + after->second * part;
}

std::vector<int> FrameCurve::frames() const {
  std::vector<int> frames;
  for (const auto& [frame, value] : keys_) frames.push_back(frame);
  return frames;
}

}  // namespace solidnoise
