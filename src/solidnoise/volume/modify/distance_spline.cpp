#include "solidnoise/volume/modify/distance_spline.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <openvdb/tools/LevelSetRebuild.h>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

constexpr double kMostVoxels = 64.0;

// A point's farthest coefficient is two voxels away along each axis.
constexpr double kSupport = 3.47;

// The four cubic B-splines that are not 0 at a fraction u in [0, 1) between two knots, and their derivatives.
struct Weights {
  std::array<double, 4> value;
  std::array<double, 4> first;
  std::array<double, 4> second;

  explicit Weights(double u) {
    const double v = 1.0 - u;
    value = {v * v * v / 6.0, (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0,
             (4.0 - 6.0 * v * v + 3.0 * v * v * v) / 6.0, u * u * u / 6.0};
    first = {-0.5 * v * v, 1.5 * u * u - 2.0 * u, 2.0 * v - 1.5 * v * v, 0.5 * u * u};
    second = {v, 3.0 * u - 2.0, 3.0 * v - 2.0, u};
  }
};

// The half width of a level set's band, and that which distances up to `reach` take, voxels.
struct LevelSetBand {
  double has = 0.0;
  double wanted = 0.0;

  bool suffices() const { return has >= wanted; }
};

LevelSetBand band_of(const openvdb::FloatGrid& level_set, double reach) {
  require_level_set(level_set);
  require_positive("boundary_width", reach, "world units");
  const double voxel = level_set.voxelSize().x();
  if (reach > kMostVoxels * voxel) {
    throw std::invalid_argument(
        fmt::format("boundary_width is {:.6g}; it must be at most {:.6g} ({} voxels of the boundary)", reach,
                    kMostVoxels * voxel, kMostVoxels));
  }
  return {std::abs(static_cast<double>(level_set.background())) / voxel, std::ceil(reach / voxel + kSupport)};
}

}  // namespace

void require_level_set(const openvdb::FloatGrid& grid) {
  if (grid.getGridClass() != openvdb::GRID_LEVEL_SET) {
    throw std::invalid_argument(fmt::format("the grid '{}' is of class {}; it must be a level set",
                                            grid.getName(),
                                            openvdb::GridBase::gridClassToString(grid.getGridClass())));
  }
  if (grid.tree().hasActiveTiles()) {
    throw std::invalid_argument(
        fmt::format("the grid '{}' has active tiles; the band of a level set is of voxels", grid.getName()));
  }
  GridFrame(grid.transform());
  if (!grid.hasUniformVoxels()) {
    throw std::invalid_argument(fmt::format("the voxels of the grid '{}' are not cubes", grid.getName()));
  }
}

DistanceSpline::DistanceSpline(const openvdb::FloatGrid::ConstPtr& level_set, double reach)
    : reach_(reach), level_set_(level_set), frame_(level_set->transform()) {
  const LevelSetBand band = band_of(*level_set, reach);
  if (band.suffices()) return;
  level_set_ = openvdb::tools::levelSetRebuild(*level_set, 0.0f, static_cast<float>(band.wanted));
}

void DistanceSpline::evaluate(std::span<const Vec<3>> positions, std::span<Jet> jets) const {
  const auto values = level_set_->getConstAccessor();
  for (std::size_t i = 0; i < positions.size(); ++i) jets[i] = at(positions[i], values);
}

DistanceSpline::Jet DistanceSpline::at(const Vec<3>& position,
                                       const openvdb::FloatGrid::ConstAccessor& values) const {
  const double voxel = frame_.voxel_size().x;
  openvdb::Coord knot;
  Vec<3> fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const double index = (position[axis] - frame_.origin()[axis]) / voxel;
    knot[axis] = static_cast<std::int32_t>(std::floor(index));
    fraction[axis] = index - std::floor(index);
  }
  Jet jet;
  jet.distance = values.getValue(knot);
  if (std::abs(jet.distance) >= reach_ + kSupport * voxel) return jet;

  const Weights x(fraction.x);
  const Weights y(fraction.y);
  const Weights z(fraction.z);
  jet.distance = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      // Along z first: the sums of values, first and second derivatives.
      double value = 0.0;
      double first = 0.0;
      double second = 0.0;
      for (int k = 0; k < 4; ++k) {
        const double coefficient = values.getValue(knot.offsetBy(i - 1, j - 1, k - 1));
        value += z.value[k] * coefficient;
        first += z.first[k] * coefficient;
        second += z.second[k] * coefficient;
      }
      jet.distance += x.value[i] * y.value[j] * value;
      jet.gradient += Vec<3>(x.first[i] * y.value[j] * value, x.value[i] * y.first[j] * value,
                             x.value[i] * y.value[j] * first);
      jet.hessian[0] += Vec<3>(x.second[i] * y.value[j] * value, x.first[i] * y.first[j] * value,
                               x.first[i] * y.value[j] * first);
      jet.hessian[1].y += x.value[i] * y.second[j] * value;
      jet.hessian[1].z += x.value[i] * y.first[j] * first;
      jet.hessian[2].z += x.value[i] * y.value[j] * second;
    }
  }
  jet.hessian[1].x = jet.hessian[0].y;
  jet.hessian[2].x = jet.hessian[0].z;
  jet.hessian[2].y = jet.hessian[1].z;
  jet.gradient /= voxel;
  for (Vec<3>& row : jet.hessian) row /= voxel * voxel;
  return jet;
}

// Rebuilding keeps the closest polygon of each voxel beside distances, and each in a second tree.
PlannedDistance::PlannedDistance(openvdb::FloatGrid::ConstPtr level_set, double reach)
    : level_set_(std::move(level_set)), reach_(reach), memory_(level_set_->memUsage()) {
  constexpr double kTrees = 4.0;
  constexpr double kSecondsPerVoxel = 5e-6;
  constexpr double kLeafVoxels = 7.0;  // that leaves reach beyond a band
  const LevelSetBand band = band_of(*level_set_, reach);
  if (band.suffices()) return;
  const double leaves = (2.0 * band.wanted + kLeafVoxels) / (2.0 * band.has + kLeafVoxels);
  memory_ += static_cast<std::uint64_t>(kTrees * leaves * static_cast<double>(memory_));
  seconds_ = kSecondsPerVoxel * band.wanted / band.has * static_cast<double>(level_set_->activeVoxelCount());
}

std::shared_ptr<const DistanceSpline> PlannedDistance::distance() const {
  const std::lock_guard lock(mutex_);
  if (!distance_) distance_ = std::make_shared<DistanceSpline>(level_set_, reach_);
  return distance_;
}

}  // namespace solidnoise
