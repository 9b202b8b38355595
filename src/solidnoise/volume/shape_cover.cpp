#include "solidnoise/volume/shape_cover.h"

#include <memory>
#include <utility>
#include <variant>

#include <glm/common.hpp>

#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/volume/shape_field.h"
#include "solidnoise/volume/topology/mesh_level_set.h"

namespace solidnoise {
namespace {

// At voxels of the frame that the distances are of.
class MeshCover final : public PointwiseField {
 public:
  MeshCover(MeshVoxels mesh, double edge) : mesh_(std::move(mesh)), edge_(edge) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    const GridFrame& frame = mesh_.topology.frame;
    const auto values = mesh_.distance->getConstAccessor();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3> index = glm::round((points.positions[i] - frame.origin()) / frame.voxel_size());
      const openvdb::Coord voxel(static_cast<int>(index.x), static_cast<int>(index.y),
                                 static_cast<int>(index.z));
      samples.values[i] = cover_at(values.getValue(voxel - mesh_.shift) * frame.voxel_size().x, edge_);
    }
  }

 private:
  MeshVoxels mesh_;
  double edge_;
};

ShapedVoxels make_mesh(const VolumePlan& plan, double edge, Progress* progress) {
  const double voxel = plan.frame.voxel_size().x;
  MeshVoxels mesh = mesh_voxels(plan.frame, *plan.mesh, 0.5 * edge / voxel, progress);
  ShapedVoxels shaped{mesh.topology, nullptr};
  if (edge > 0.0) shaped.cover = std::make_shared<MeshCover>(std::move(mesh), edge);
  return shaped;
}

}  // namespace

ShapedVoxels make_shape(const VolumeRecipe& recipe, const VolumePlan& plan, Progress* progress) {
  if (plan.grid) return {grid_topology(*plan.grid), nullptr};
  const double edge = edge_of(recipe, plan.frame.voxel_size());
  if (std::holds_alternative<MeshShape>(recipe.shape)) return make_mesh(plan, edge, progress);
  FieldPtr cover = edge > 0.0 ? cover_of(recipe.shape, plan.box, edge) : nullptr;
  if (const auto body = ellipsoid_of(recipe.shape, plan.box)) {
    return {ellipsoid_topology(plan.frame, body->centre, body->radii + 0.5 * edge), std::move(cover)};
  }
  const Box<3> box{plan.box.lower - 0.5 * edge, plan.box.upper + 0.5 * edge};
  return {box_topology(plan.frame, box), std::move(cover)};
}

}  // namespace solidnoise
