#include <memory>
#include <stdexcept>

#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include "solidnoise/volume/topology/index_mesh.h"
#include "solidnoise/volume/topology/interrupter.h"
#include "solidnoise/volume/topology/topology.h"

namespace solidnoise {
namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

// The voxels where the mesh's distance is negative, as leaves only.
openvdb::MaskTree::Ptr inside(const IndexMesh& mesh, Progress* progress) {
  // Only the sign is used; narrower bands than this leave gaps between the voxels whose sign is certain.
  constexpr float kHalfWidth = 1.5f;  // voxels
  Interrupter interrupter(progress);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(mesh.points,
                                                                                           mesh.triangles);
  const auto distance = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      interrupter.base(), adapter, *openvdb::math::Transform::createLinearTransform(1.0), kHalfWidth,
      kHalfWidth);
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
