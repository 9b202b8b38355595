#include "solidnoise/volume/shape_cover.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/volume/topology/mesh_level_set.h"

namespace solidnoise {
namespace {

float cover_at(double distance, double edge) {
  return static_cast<float>(std::clamp(0.5 - distance / edge, 0.0, 1.0));
}

class EllipsoidCover final : public PointwiseField {
 public:
  EllipsoidCover(const Vec<3>& centre, const Vec<3>& radii, double edge)
      : centre_(centre), radii_(radii), edge_(edge) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3> q = (points.positions[i] - centre_) / radii_;
      const double k = glm::length(q);
      const double slope = glm::length(q / radii_);
      const double least = std::min({radii_.x, radii_.y, radii_.z});
      samples.values[i] = cover_at(slope > 0.0 ? (k - 1.0) * k / slope : -least, edge_);
    }
  }

 private:
  Vec<3> centre_;
  Vec<3> radii_;
  double edge_;
};

class BoxCover final : public PointwiseField {
 public:
  BoxCover(const Box<3>& box, double edge) : box_(box), edge_(edge) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      float cover = 1.0f;
      for (int axis = 0; axis < 3; ++axis) {
        const double p = points.positions[i][axis];
        cover *= cover_at(box_.lower[axis] - p, edge_) * cover_at(p - box_.upper[axis], edge_);
      }
      samples.values[i] = cover;
    }
  }

 private:
  Box<3> box_;
  double edge_;
};

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

bool has_density(const VolumeRecipe& recipe) {
  return std::ranges::any_of(recipes_of_grids(recipe), [](const VolumeRecipe& grid) {
    return !std::holds_alternative<RawShaping>(grid.shaping);
  });
}

ShapedVoxels make_ellipsoid(const VolumePlan& plan, const Vec<3>& radii, double edge) {
  const Vec<3> centre = (plan.box.lower + plan.box.upper) * 0.5;
  ShapedVoxels shaped{ellipsoid_topology(plan.frame, centre, radii + 0.5 * edge), nullptr};
  if (edge > 0.0) shaped.cover = std::make_shared<EllipsoidCover>(centre, radii, edge);
  return shaped;
}

ShapedVoxels make_mesh(const VolumePlan& plan, double edge, Progress* progress) {
  const double voxel = plan.frame.voxel_size().x;
  MeshVoxels mesh = mesh_voxels(plan.frame, *plan.mesh, 0.5 * edge / voxel, progress);
  ShapedVoxels shaped{mesh.topology, nullptr};
  if (edge > 0.0) shaped.cover = std::make_shared<MeshCover>(std::move(mesh), edge);
  return shaped;
}

}  // namespace

double edge_of(const VolumeRecipe& recipe, const Vec<3>& voxel) {
  const bool is_box = std::holds_alternative<BoxShape>(recipe.shape);
  if (std::holds_alternative<GridShape>(recipe.shape) || !has_density(recipe)) return 0.0;
  constexpr double kVoxels = 2.0;  // from one to the next no step is over a half
  const double voxels = recipe.edge_voxels.value_or(is_box ? 0.0 : kVoxels);
  return recipe.edge.value_or(voxels * std::max({voxel.x, voxel.y, voxel.z}));
}

ShapedVoxels make_shape(const VolumeRecipe& recipe, const VolumePlan& plan, Progress* progress) {
  if (plan.grid) return {grid_topology(*plan.grid), nullptr};
  const Vec<3> radii = (plan.box.upper - plan.box.lower) * 0.5;
  const double edge = edge_of(recipe, plan.frame.voxel_size());
  if (std::holds_alternative<MeshShape>(recipe.shape)) return make_mesh(plan, edge, progress);
  if (std::holds_alternative<EllipsoidShape>(recipe.shape)) return make_ellipsoid(plan, radii, edge);
  if (std::holds_alternative<SphereShape>(recipe.shape)) {
    return make_ellipsoid(plan, Vec<3>(std::min({radii.x, radii.y, radii.z})), edge);
  }
  if (edge == 0.0) return {box_topology(plan.frame, plan.box), nullptr};
  const Box<3> box{plan.box.lower - 0.5 * edge, plan.box.upper + 0.5 * edge};
  return {box_topology(plan.frame, box), std::make_shared<BoxCover>(plan.box, edge)};
}

}  // namespace solidnoise
