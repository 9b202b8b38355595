#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include "solidnoise/volume/topology/interrupter.h"
#include "solidnoise/volume/topology/topology.h"

namespace solidnoise {
namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

// The mesh in index space, moved by whole leaves close to the origin, because meshToVolume computes in single
// precision.
struct IndexMesh {
  openvdb::Coord shift;  // what was taken off
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
};

IndexMesh to_index_space(const GridFrame& frame, const TriangleMesh& mesh) {
  const Box<3> bounds = mesh.bounds();
  frame.voxels_in(bounds);  // refuses what has no 32-bit index
  IndexMesh result;
  Vec<3> zero;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = (bounds.lower[axis] - frame.origin()[axis]) / frame.voxel_size()[axis];
    result.shift[axis] =
        static_cast<std::int32_t>(std::floor(lower / MaskLeaf::DIM)) * static_cast<int>(MaskLeaf::DIM);
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

// The voxels where the mesh's distance is negative, as leaves only.
openvdb::MaskTree::Ptr inside(const IndexMesh& mesh, Progress* progress) {
  // Only the sign is used; narrower bands than this leave gaps between the voxels whose sign is certain.
  constexpr float kHalfWidth = 1.5f;  // voxels
  Interrupter interrupter(progress);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(mesh.points,
                                                                                           mesh.triangles);
  const auto distance = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      interrupter, adapter, *openvdb::math::Transform::createLinearTransform(1.0), kHalfWidth, kHalfWidth);
  throw_if_cancelled(progress);

  const openvdb::BoolGrid::Ptr interior = openvdb::tools::sdfInteriorMask(*distance, 0.0f);
  interior->tree().voxelizeActiveTiles();
  auto mask = std::make_shared<openvdb::MaskTree>(false);
  for (auto leaf = interior->tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    auto copy = std::make_unique<MaskLeaf>(*leaf, openvdb::TopologyCopy());
    copy->setOrigin(leaf->origin() + mesh.shift);
    mask->addLeaf(copy.release());
  }
  return mask;
}

}  // namespace

Topology mesh_topology(const GridFrame& frame, const TriangleMesh& mesh, Progress* progress) {
  require_closed(mesh);
  const Vec<3> voxel = frame.voxel_size();
  if (voxel.x != voxel.y || voxel.y != voxel.z) {
    throw std::invalid_argument("the inside of a mesh needs voxels that are cubes");
  }
  Topology topology{frame, inside(to_index_space(frame, mesh), progress)};
  if (topology.mask->empty()) {
    throw std::invalid_argument("the mesh holds no voxel's centre: make it larger, or the voxels smaller");
  }
  return topology;
}

}  // namespace solidnoise
