#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/geometry/mesh_file.h"

namespace solidnoise {

// Of a file, and of all that a buffer holds.
inline constexpr std::uint64_t kMostGltfBytes = std::uint64_t{1} << 36;

// A glTF file's text, and the bytes that a .glb has behind it.
struct GltfFile {
  nlohmann::ordered_json json;
  std::string_view binary;  // of the file's bytes; empty where there are none
};

// Throws std::runtime_error that names the file.
[[noreturn]] void refuse_gltf(const std::string& name, const std::string& what);

// Throws std::runtime_error naming the file: no glTF 2, a damaged container, a text that is no JSON object or
// nested more than 64 deep.
GltfFile parse_gltf(std::string_view bytes, MeshFormat format, const std::string& name);

// What of the text its mesh is made of, and no more: buffers, views, accessors, primitives, nodes, scenes.
// All numbers are of their kind, all indices are those of something, no node is its own ancestor. Throws
// std::runtime_error naming the file and what is wrong: also what we do not read, compressed meshes, and
// files elsewhere than beside it.
nlohmann::json checked_gltf(const GltfFile& file, const std::string& name);

// The vertices of a glTF file that are one after the other in its mesh: those of one accessor, in one mesh.
struct GltfBlock {
  int mesh = 0;
  int accessor = 0;  // of the positions
  std::size_t first = 0;
  std::size_t count = 0;
};

struct GltfPrimitive {
  int mesh = 0;
  int primitive = 0;
  std::size_t block = 0;
};

struct GltfMesh {
  MeshReading reading;
  std::vector<GltfBlock> blocks;
  std::vector<GltfPrimitive> primitives;
};

// The file's meshes, by tinygltf, as one: each where the first node that has it puts it. Throws
// std::runtime_error.
GltfMesh load_gltf(const GltfFile& file, const std::string& name);

}  // namespace solidnoise
