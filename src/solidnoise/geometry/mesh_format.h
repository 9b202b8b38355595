#pragma once

#include <filesystem>

namespace solidnoise {

// The files of meshes: Stanford PLY, Wavefront OBJ, Geomview OFF, stereolithography STL and OpenMesh's OM.
enum class MeshFormat { ply, obj, off, stl, om };

// The format that the path's extension names, in any case. Throws std::runtime_error naming the path if it
// names none.
MeshFormat mesh_format(const std::filesystem::path& path);

// Whether mesh_format would name one.
bool is_mesh_path(const std::filesystem::path& path);

}  // namespace solidnoise
