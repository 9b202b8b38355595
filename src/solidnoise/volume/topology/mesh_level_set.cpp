#include "solidnoise/volume/topology/mesh_level_set.h"

#include <stdexcept>

#include <fmt/format.h>
#include <openvdb/tools/MeshToVolume.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/topology/index_mesh.h"
#include "solidnoise/volume/topology/interrupter.h"

namespace solidnoise {
namespace {

constexpr double kLeastBand = 3.0;  // voxels, OpenVDB's narrow band
constexpr double kMostBand = 1000.0;

}  // namespace

openvdb::FloatGrid::Ptr mesh_level_set(const TriangleMesh& mesh, double voxel, double band,
                                       Progress* progress) {
  require_closed(mesh);
  const GridFrame frame(voxel);
  require_in_range("band", band, kLeastBand * voxel, kMostBand * voxel, "world units, 3 to 1000 voxels");
  const IndexMesh index_mesh = to_index_space(frame, mesh);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(
      index_mesh.points, index_mesh.triangles);
  Interrupter interrupter(progress);
  const auto half_width = static_cast<float>(band / voxel);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(interrupter, adapter, *transform,
                                                                     half_width, half_width);
  throw_if_cancelled(progress);
  grid->setTransform(transform);
  grid->transform().preTranslate(index_mesh.shift.asVec3d());
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

}  // namespace solidnoise
