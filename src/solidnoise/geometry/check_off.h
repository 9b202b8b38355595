#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// An OFF file in the form that OpenMesh's reader takes.
struct CheckedOff {
  std::string keyword;  // [ST][C][N]OFF
  std::string text;     // keyword, counts, then a line per vertex and face
  std::vector<std::string> comments;
  std::vector<std::string> notes;
  std::vector<Vec<3>> positions;  // those of the text, which OpenMesh reads in single precision
  ScalarType position_type = ScalarType::float32;
};

// Checks an OFF file number by number, and throws std::runtime_error that names it, the line and the vertex
// or face. OpenMesh's reader knows no comments, no counts beside the keyword, no blanks but single spaces
// and, but in COFF, no colours of faces; it takes colours for floats where the first part has a point, and
// stops without a word at a number that it cannot read. So the text has none of these: numbers that are not
// finite are 0.
CheckedOff check_off(std::string_view bytes, const std::string& name);

}  // namespace solidnoise
