#include "solidnoise/volume/topology/mesh_level_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/topology/interrupter.h"
#include "solidnoise/volume/topology/topology.h"

namespace solidnoise {

namespace {

// The mesh in index space, moved by whole leaves close to the origin, because meshToVolume computes in single
// precision.
struct IndexMesh {
  openvdb::Coord shift;  // what was taken off
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
};

// Throws std::invalid_argument if an index would leave +-2^30.
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

constexpr double kLeastBand = 3.0;  // voxels, OpenVDB's narrow band
constexpr double kMostBand = 1000.0;

void require_band(double voxel, double band) {
  require_positive("voxel", voxel, "world units");
  require_in_range("band", band, kLeastBand * voxel, kMostBand * voxel, "world units, 3 to 1000 voxels");
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    const Vec<3>& corner = mesh.positions[triangle[0]];
    area += 0.5 * glm::length(
                      glm::cross(mesh.positions[triangle[1]] - corner, mesh.positions[triangle[2]] - corner));
  }
  return area;
}

}  // namespace

// The band touches the leaves whose voxels are within it and half a leaf's diagonal, 7 voxels, of the
// surface; but no more than there are in the bounds. Beside distances OpenVDB keeps the closest triangle of
// each voxel, and each in a second tree while it widens the band.
Cost level_set_cost(const TriangleMesh& mesh, double voxel, double band) {
  constexpr double kProgramBytes = 46.0 * 0x1p20;
  constexpr double kBytesPerTriangle = 128.0;  // with its vertices, read and in index space
  constexpr double kSecondsPerVoxel = 190e-9;
  constexpr double kSecondsPerTriangle = 2e-6;  // read, looked at and placed
  constexpr double kLeafVoxels = 512.0;
  constexpr double kHalfDiagonal = 7.0;
  constexpr double kBytesPerLeaf = kLeafVoxels * (sizeof(float) + sizeof(std::int32_t)) + 400.0;
  constexpr double kTrees = 2.0;
  require_band(voxel, band);
  const double reach = band / voxel + kHalfDiagonal;
  const Box<3> bounds = mesh.bounds();
  const Vec<3> size = (bounds.upper - bounds.lower) / voxel + Vec<3>(2.0 * reach);
  const double in_band = area_of(mesh) / (voxel * voxel) * 2.0 * reach;
  const double voxels = std::min(in_band, size.x * size.y * size.z);
  const auto triangles = static_cast<double>(mesh.triangles.size());
  const double bytes = kProgramBytes + kBytesPerTriangle * triangles;
  return {kSecondsPerVoxel * voxels + kSecondsPerTriangle * triangles,
          bytes + voxels / kLeafVoxels * kBytesPerLeaf * kTrees};
}

openvdb::FloatGrid::Ptr mesh_level_set(const TriangleMesh& mesh, double voxel, double band,
                                       Progress* progress) {
  require_closed(mesh);
  require_band(voxel, band);
  const GridFrame frame(voxel);
  const IndexMesh index_mesh = to_index_space(frame, mesh);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(
      index_mesh.points, index_mesh.triangles);
  Interrupter interrupter(progress);
  const auto half_width = static_cast<float>(band / voxel);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(interrupter.base(), adapter, *transform,
                                                                     half_width, half_width);
  throw_if_cancelled(progress);
  grid->setTransform(transform);
  grid->transform().preTranslate(index_mesh.shift.asVec3d());
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

// The distances to the mesh in voxels, in a band of `half_width` of them.
openvdb::FloatGrid::Ptr measure_distance(const IndexMesh& mesh, double half_width, Progress* progress) {
  Interrupter interrupter(progress);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(mesh.points,
                                                                                           mesh.triangles);
  const auto band = static_cast<float>(half_width);
  const auto distance = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      interrupter.base(), adapter, *openvdb::math::Transform::createLinearTransform(1.0), band, band);
  throw_if_cancelled(progress);
  return distance;
}

// The voxels where it is below `outside`, as leaves only.
openvdb::MaskTree::Ptr voxels_below(const openvdb::FloatGrid& distance, double outside,
                                    const openvdb::Coord& shift) {
  const openvdb::BoolGrid::Ptr interior =
      openvdb::tools::sdfInteriorMask(distance, static_cast<float>(outside));
  interior->tree().voxelizeActiveTiles();
  auto mask = std::make_shared<openvdb::MaskTree>(false);
  for (auto leaf = interior->tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    auto copy = std::make_unique<MaskLeaf>(*leaf, openvdb::TopologyCopy());
    copy->setOrigin(leaf->origin() + shift);
    mask->addLeaf(copy.release());
  }
  return mask;
}

}  // namespace

MeshVoxels mesh_voxels(const GridFrame& frame, const TriangleMesh& mesh, double outside, Progress* progress) {
  // Where only the sign is used; narrower bands than this leave gaps between the voxels whose sign is
  // certain.
  constexpr double kHalfWidth = 1.5;  // voxels
  require_closed(mesh);
  const Vec<3> voxel = frame.voxel_size();
  if (voxel.x != voxel.y || voxel.y != voxel.z) {
    throw std::invalid_argument("the inside of a mesh needs voxels that are cubes");
  }
  const IndexMesh index_mesh = to_index_space(frame, mesh);
  const openvdb::FloatGrid::Ptr distance = measure_distance(index_mesh, outside + kHalfWidth, progress);
  MeshVoxels voxels{{frame, voxels_below(*distance, outside, index_mesh.shift)}, distance, index_mesh.shift};
  if (voxels.topology.mask->empty()) {
    throw std::invalid_argument("the mesh holds no voxel's centre: make it larger, or the voxels smaller");
  }
  return voxels;
}

}  // namespace solidnoise
