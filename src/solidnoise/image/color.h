#pragma once

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

}  // namespace solidnoise
