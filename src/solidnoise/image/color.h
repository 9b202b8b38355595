#pragma once

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace solidnoise {

// Red, green and blue. Each use says whether they are in linear light or sRGB-encoded.
using Color = glm::vec3;

// The transfer functions of sRGB (IEC 61966-2-1), per channel. Values below 0 are mirrored and values above 1
// continued, so that each function is the other's inverse everywhere.
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);

Color srgb_from_linear(const Color& linear);
Color linear_from_srgb(const Color& encoded);

struct ColorStop {
  float position = 0.0f;  // the value that gets this colour; any finite number
  Color color{0.0f};      // sRGB-encoded, each channel 0 to 1
};

// A function from values to colours, linear between its stops and constant beyond the first and the last one.
// Stops are given in sRGB, as they are picked on a screen, and blended in linear light, as light mixes. Two
// stops at one position make a hard edge; the value at the edge belongs to the later one.
class ColorRamp {
 public:
  // Throws std::invalid_argument for fewer than two stops, positions that decrease, values out of range.
  explicit ColorRamp(std::vector<ColorStop> stops);

  // The colour of `value`, in linear light and sRGB-encoded. Not-a-number gets the first stop's colour.
  Color linear(float value) const;
  Color srgb(float value) const { return srgb_from_linear(linear(value)); }

  const std::vector<ColorStop>& stops() const { return stops_; }

 private:
  std::vector<ColorStop> stops_;
  std::vector<Color> linear_;  // the stops' colours in linear light
};

// A ramp by its name (one of ramp_names(), with positions from 0 to 1), or from a list of stops such as
// "0:#000,0.5:#4080ff,1:#fff". Throws std::invalid_argument that quotes the text at fault and says what is
// allowed.
ColorRamp parse_color_ramp(std::string_view text);

// viridis (perceptually even), grey, marble, rust, scales.
std::vector<std::string_view> ramp_names();

}  // namespace solidnoise
