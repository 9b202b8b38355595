#pragma once

#include <algorithm>

namespace solidnoise {

// 3 t^2 - 2 t^3 of t clamped to 0..1.
inline float smoothstep(float t) {
  const float s = std::clamp(t, 0.0f, 1.0f);
  return s * s * (3.0f - 2.0f * s);
}

}  // namespace solidnoise
