#include "solidnoise/volume/topology/index_mesh.h"

#include <cmath>
#include <cstdint>

namespace solidnoise {

IndexMesh to_index_space(const GridFrame& frame, const TriangleMesh& mesh) {
  constexpr int kLeaf = 8;  // voxels along a leaf's side
  const Box<3> bounds = mesh.bounds();
  frame.voxels_in(bounds);  // refuses what has no 32-bit index
  IndexMesh result;
  Vec<3> zero;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = (bounds.lower[axis] - frame.origin()[axis]) / frame.voxel_size()[axis];
    result.shift[axis] = static_cast<std::int32_t>(std::floor(lower / kLeaf)) * kLeaf;
    zero[axis] = result.shift[axis];
  }
  result.points.reserve(mesh.positions.size());
  for (const Vec<3>& position : mesh.positions) {
    const Vec<3> index = (position - frame.origin()) / frame.voxel_size() - zero;
    result.points.emplace_back(static_cast<float>(index.x), static_cast<float>(index.y),
                               static_cast<float>(index.z));
  }
  result.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) result.triangles.emplace_back(t[0], t[1], t[2]);
  return result;
}

}  // namespace solidnoise
