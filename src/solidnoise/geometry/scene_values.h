#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// What files of scenes, .glb and .usda, want of a mesh's numbers.

// A value as a float32 holds it: clamped, and 0 where it is not finite.
double float_value(double value);

// The channels of a vertex's colour in linear light, 0 to 1 (IEC 61966-2-1); alpha is as it is.
double linear_color(const VertexProperty& channel, std::size_t vertex);

// A normal of length 1 for each vertex: the mesh's own, else the sum of its triangles', longer ones for
// larger triangles; along y where neither has a direction.
std::vector<Vec<3>> unit_normals(const PolygonMesh& mesh);

// Properties that are no part of a colour, a normal or texture coordinates.
std::vector<const VertexProperty*> plain_numbers(const PolygonMesh& mesh);

// The same, where those of NAME_x, NAME_y and NAME_z that follow each other are one vector.
struct SceneNumber {
  std::string name;
  std::vector<const VertexProperty*> parts;  // 1, or 3 of a vector
};
std::vector<SceneNumber> plain_vectors(const PolygonMesh& mesh);

// The lower and the upper corner of the box of all positions, as float32.
struct FloatBox {
  Vec<3> lower{0.0};
  Vec<3> upper{0.0};
};
FloatBox float_box(const PolygonMesh& mesh);

// A text between quotation marks, with what JSON and USD escape; ? for what is no ASCII.
std::string quoted_text(std::string_view text);

// A name as USD's prims and properties have them: letters, digits and _, no digit first.
std::string usd_name(std::string_view name);

// Throws std::invalid_argument naming the format for a position beyond float32.
void require_float_positions(const PolygonMesh& mesh, std::string_view format);

}  // namespace solidnoise
