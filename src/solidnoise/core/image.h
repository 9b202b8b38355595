#pragma once

#include <cstddef>
#include <vector>

namespace solidnoise {

// A picture in memory: `channels` floats per pixel, pixels of a row next to each other, row 0 at the top.
// What the numbers mean (linear light, sRGB-encoded, plain data) is said where a picture is made.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;

  Image() = default;
  Image(int width_, int height_, int channels_)
      : width(width_),
        height(height_),
        channels(channels_),
        pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
               static_cast<std::size_t>(channels_)) {}

  std::size_t index(int x, int y, int channel = 0) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels) +
           static_cast<std::size_t>(channel);
  }
  float& at(int x, int y, int channel = 0) { return pixels[index(x, y, channel)]; }
  float at(int x, int y, int channel = 0) const { return pixels[index(x, y, channel)]; }
};

}  // namespace solidnoise
