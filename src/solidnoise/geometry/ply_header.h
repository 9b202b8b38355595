#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::float32;
  std::optional<ScalarType> count_type = {};  // of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  // also lines of obj_info
  bool has_info = false;              // whether there are any
  std::size_t bytes = 0;              // its length
  std::size_t lines = 0;
};

// The name that the format gives a type: float, uchar, ...
std::string_view ply_type_name(ScalarType type);

// The header of a PLY file. Throws std::runtime_error naming the path and the line.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace solidnoise
