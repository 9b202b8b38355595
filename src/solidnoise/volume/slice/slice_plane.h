#pragma once

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Where the pixels of a slice lie in the world: squares around a middle, in columns from left to right and
// rows from the bottom up.
struct SlicePlane {
  Vec<3> origin{0.0};           // the middle of the picture, world units
  Vec<3> right{1.0, 0.0, 0.0};  // unit vectors, perpendicular
  Vec<3> up{0.0, 1.0, 0.0};
  double pixel = 1.0;  // side of a pixel, world units; > 0
  int columns = 512;
  int rows = 512;

  // The centre of a pixel.
  Vec<3> position(int column, int row) const {
    return origin + (pixel * (column + 0.5 - 0.5 * columns)) * right +
           (pixel * (row + 0.5 - 0.5 * rows)) * up;
  }

  // Its coordinate along the line to the right.
  double coordinate(int column) const;

  // Puts the plane across a normal, its upward direction as near to `upward` as that allows; or so that
  // `rightward` goes to the right. Vectors may have any length; throws std::invalid_argument for those of
  // none, or that are parallel.
  void face(const Vec<3>& normal, const Vec<3>& upward);
  void span(const Vec<3>& rightward, const Vec<3>& upward);
};

}  // namespace solidnoise
