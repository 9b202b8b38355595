#include "solidnoise/image/color.h"

#include <cmath>

namespace solidnoise {

float srgb_from_linear(float linear) {
  const float magnitude = std::abs(linear);
  const float encoded =
      magnitude <= 0.0031308f ? 12.92f * magnitude : 1.055f * std::pow(magnitude, 1.0f / 2.4f) - 0.055f;
  return std::copysign(encoded, linear);
}

float linear_from_srgb(float encoded) {
  const float magnitude = std::abs(encoded);
  const float linear =
      magnitude <= 0.04045f ? magnitude / 12.92f : std::pow((magnitude + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, encoded);
}

Color srgb_from_linear(const Color& linear) {
  return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z)};
}

Color linear_from_srgb(const Color& encoded) {
  return {linear_from_srgb(encoded.x), linear_from_srgb(encoded.y), linear_from_srgb(encoded.z)};
}

}  // namespace solidnoise
