#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "solidnoise/geometry/number_writer.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

inline constexpr int kGltfFloat = 5126;

// Numbers of vertices that stand together in a glTF file, and what its text says of them.
struct GltfAttribute {
  std::string name{};  // empty: the corners of triangles
  std::string type{};  // SCALAR, VEC3, ...
  int component = kGltfFloat;
  std::size_t count = 0;
  std::size_t bytes = 0;
  bool normalized = false;
  std::string limits{};  // of the values, where it has to say them
  std::function<void(NumberWriter&)> write{};
};

// Of float32, `width` (1 to 3) to a vertex, from vertex `first` on; what is not finite becomes 0.
GltfAttribute gltf_floats(const std::string& name, std::size_t width, std::size_t first, std::size_t count,
                          const std::function<double(std::size_t vertex, std::size_t part)>& value);

// What a mesh's vertices from `first` on have that other files of the same vertices have not: colours, in
// linear light, and numbers, with a _ before their names in capitals. Throws std::invalid_argument for two of
// one name there.
std::vector<GltfAttribute> gltf_attributes(const PolygonMesh& mesh, std::size_t first, std::size_t count);

// The head of a .glb, up to the bytes behind its text.
void write_glb_head(NumberWriter& out, std::string text, std::size_t bytes);

}  // namespace solidnoise
