#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "solidnoise/image/image_file.h"
#include "support/paths.h"
#include "tools/run_tool.h"

namespace solidnoise {

inline ToolResult run_noisefit(const std::vector<std::string>& arguments, const RunOptions& options = {}) {
  return RunningTool(in_build("tools/noisefit"), arguments, options).wait();
}

// A texture of some waves, in colour.
inline Image wavy_picture(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float value = std::sin(0.9f * static_cast<float>(x)) +
                          std::sin(0.4f * static_cast<float>(x + 2 * y)) +
                          std::sin(0.013f * static_cast<float>(x * y));
      for (int c = 0; c < channels; ++c) {
        image.at(x, y, c) =
            0.5f + 0.1f * value + 0.02f * static_cast<float>(c) * std::cos(0.7f * static_cast<float>(y));
      }
    }
  }
  return image;
}

}  // namespace solidnoise
