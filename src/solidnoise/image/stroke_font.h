#pragma once

#include <vector>

#include "solidnoise/image/drawing.h"

namespace solidnoise {

// A letter as a pen draws it: polylines with y upwards from the base line, in units of which a capital letter
// is kCapitalHeight high.
struct StrokeGlyph {
  double width = 0.0;
  std::vector<std::vector<Point>> strokes;
};

inline constexpr double kCapitalHeight = 12.0;
inline constexpr double kLetterSpacing = 3.3;  // between the widths of two letters

StrokeGlyph stroke_glyph(char character);

}  // namespace solidnoise
