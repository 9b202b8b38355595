#include "solidnoise/volume/shape_field.h"

#include <algorithm>
#include <memory>
#include <variant>

#include <glm/geometric.hpp>

#include "solidnoise/field/pointwise_field.h"

namespace solidnoise {
namespace {

class EllipsoidCover final : public PointwiseField {
 public:
  EllipsoidCover(const Ellipsoid& body, double edge) : body_(body), edge_(edge) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3> q = (points.positions[i] - body_.centre) / body_.radii;
      const double k = glm::length(q);
      const double slope = glm::length(q / body_.radii);
      const double least = std::min({body_.radii.x, body_.radii.y, body_.radii.z});
      samples.values[i] = cover_at(slope > 0.0 ? (k - 1.0) * k / slope : -least, edge_);
    }
  }

 private:
  Ellipsoid body_;
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

}  // namespace

float cover_at(double distance, double edge) {
  return static_cast<float>(std::clamp(0.5 - distance / edge, 0.0, 1.0));
}

std::optional<Ellipsoid> ellipsoid_of(const Shape& shape, const Box<3>& box) {
  const Vec<3> centre = (box.lower + box.upper) * 0.5;
  const Vec<3> radii = (box.upper - box.lower) * 0.5;
  if (std::holds_alternative<EllipsoidShape>(shape)) return Ellipsoid{centre, radii};
  if (std::holds_alternative<SphereShape>(shape)) {
    return Ellipsoid{centre, Vec<3>(std::min({radii.x, radii.y, radii.z}))};
  }
  return std::nullopt;
}

FieldPtr cover_of(const Shape& shape, const Box<3>& box, double edge) {
  if (const auto body = ellipsoid_of(shape, box)) return std::make_shared<EllipsoidCover>(*body, edge);
  return std::make_shared<BoxCover>(box, edge);
}

bool has_density(const VolumeRecipe& recipe) {
  return std::ranges::any_of(recipes_of_grids(recipe), [](const VolumeRecipe& grid) {
    return !std::holds_alternative<RawShaping>(grid.shaping);
  });
}

double edge_of(const VolumeRecipe& recipe, const Vec<3>& voxel) {
  const bool is_box = std::holds_alternative<BoxShape>(recipe.shape);
  if (std::holds_alternative<GridShape>(recipe.shape) || !has_density(recipe)) return 0.0;
  constexpr double kVoxels = 2.0;  // from one to the next no step is over a half
  const double voxels = recipe.edge_voxels.value_or(is_box ? 0.0 : kVoxels);
  return recipe.edge.value_or(voxels * std::max({voxel.x, voxel.y, voxel.z}));
}

FieldPtr shape_at_points(const VolumeRecipe& recipe, double sample) {
  constexpr double kHard = 1e-6;  // of a sample
  return cover_of(recipe.shape, recipe.box, std::max(edge_of(recipe, Vec<3>(sample)), kHard * sample));
}

}  // namespace solidnoise
