#include "solidnoise/volume/parameters/scalar_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace solidnoise {
namespace {

using openvdb::Coord;

// Voxels whose value is not allowed.
struct Refused {
  std::uint64_t count = 0;
  Coord first;
  float value = 0.0f;  // of the first

  void add(const Coord& voxel, float its_value, std::uint64_t voxels = 1) {
    if (count == 0 || voxel < first) {
      first = voxel;
      value = its_value;
    }
    count += voxels;
  }
  void add(const Refused& other) {
    if (other.count > 0) add(other.first, other.value, other.count);
  }
};

std::string text_of(const Coord& voxel) {
  return fmt::format("({}, {}, {})", voxel.x(), voxel.y(), voxel.z());
}

}  // namespace

// The grid's value anywhere: trilinear between voxels. Neighbouring positions are often between the same
// ones, whose values are kept.
class ScalarField::Sampler {
 public:
  explicit Sampler(const openvdb::FloatGrid& grid)
      : transform_(grid.transform()), accessor_(grid.getConstUnsafeAccessor()) {}

  float at(const Vec<3>& position) {
    const openvdb::Vec3d index = transform_.worldToIndex(openvdb::Vec3d(position.x, position.y, position.z));
    const Coord corner = Coord::floor(index);
    if (!(corner == corner_)) read(corner);
    const openvdb::Vec3d t = index - corner.asVec3d();
    const auto mix = [](double a, double b, double fraction) { return a + (b - a) * fraction; };
    std::array<double, 4> along_z;
    for (std::size_t i = 0; i < 4; ++i) along_z[i] = mix(values_[2 * i], values_[2 * i + 1], t.z());
    return static_cast<float>(
        mix(mix(along_z[0], along_z[1], t.y()), mix(along_z[2], along_z[3], t.y()), t.x()));
  }

 private:
  void read(const Coord& corner) {
    corner_ = corner;
    for (int i = 0; i < 8; ++i) {
      values_[static_cast<std::size_t>(i)] = accessor_.getValue(corner.offsetBy(i >> 2, i >> 1 & 1, i & 1));
    }
  }

  const openvdb::math::Transform& transform_;
  openvdb::FloatGrid::ConstUnsafeAccessor accessor_;
  Coord corner_ = Coord::max();
  std::array<double, 8> values_{};
};

ScalarField::ScalarField(ParameterGrid& source, const std::string& flag, const AllowedValues& range,
                         Progress* progress)
    : grid_(read_float_grid(source.source, flag, progress)),
      map_(source.map),
      by_ratio_(range.without_lowest),
      octaves_(map_ && by_ratio_ ? std::log2(map_->at_high / map_->at_low) : 0.0),
      range_(range),
      name_(fmt::format("{}: grid '{}'", source.source.file, grid_->getName())),
      map_flag_(flag.substr(0, flag.rfind("-grid")) + "-map") {
  if (grid_->activeVoxelCount() == 0) throw std::runtime_error(name_ + " has no active voxels");
  require_allowed_values();
}

float ScalarField::mapped(float value) const {
  if (!map_) return value;
  if (!std::isfinite(value)) return std::numeric_limits<float>::quiet_NaN();
  const double t = std::clamp((static_cast<double>(value) - map_->low) / (map_->high - map_->low), 0.0, 1.0);
  if (by_ratio_) return static_cast<float>(map_->at_low * std::exp2(t * octaves_));
  return static_cast<float>((1.0 - t) * map_->at_low + t * map_->at_high);
}

bool ScalarField::allows(float value) const {
  return map_ ? std::isfinite(value) : range_.allows(value);
}

std::string ScalarField::outside() const {
  return fmt::format(", and outside of its active voxels its background, {}, counts", grid_->background());
}

std::string ScalarField::refusal(const std::string& why) const {
  const std::string advice = map_ ? "" : fmt::format("; {} says what other values mean", map_flag_);
  return fmt::format("it must be {}{}{}", map_ ? "finite" : range_.allowed, why, advice);
}

void ScalarField::require_allowed_values() {
  Refused refused;
  least_ = std::numeric_limits<float>::infinity();
  greatest_ = -least_;
  for (auto value = grid_->cbeginValueOn(); value; ++value) {
    if (!allows(*value)) refused.add(value.getCoord(), *value, value.getVoxelCount());
    const float parameter = mapped(*value);
    least_ = std::min(least_, parameter);
    greatest_ = std::max(greatest_, parameter);
  }
  if (refused.count > 0) {
    throw std::runtime_error(fmt::format("{} is {} at voxel {}, and not allowed in {} of its {} voxels; {}",
                                         name_, refused.value, text_of(refused.first), refused.count,
                                         grid_->activeVoxelCount(), refusal("")));
  }
  all_allowed_ = allows(grid_->background());
  for (auto value = grid_->cbeginValueOff(); value && all_allowed_; ++value) all_allowed_ = allows(*value);
}

void ScalarField::evaluate(const Points<3>& points, const Samples<3>& samples) const {
  Sampler sampler(*grid_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float value = sampler.at(points.positions[i]);
    if (!allows(value)) {
      const Vec<3>& p = points.positions[i];
      throw std::runtime_error(fmt::format("{} is {} at ({:.6g}, {:.6g}, {:.6g}); {}", name_, value, p.x, p.y,
                                           p.z, refusal(outside())));
    }
    samples.values[i] = mapped(value);
  }
}

void ScalarField::require_allowed_at(const Topology& topology) const {
  if (all_allowed_) return;
  std::vector<const openvdb::MaskTree::LeafNodeType*> leaves;
  topology.mask->getNodes(leaves);
  std::vector<Refused> refused(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t leaf) {
    Sampler sampler(*grid_);
    for (auto voxel = leaves[leaf]->cbeginValueOn(); voxel; ++voxel) {
      const Coord index = voxel.getCoord();
      const float value = sampler.at(topology.frame.bounds({index, index}).lower);
      if (!allows(value)) refused[leaf].add(index, value);
    }
  });
  Refused all;
  for (const Refused& of_leaf : refused) all.add(of_leaf);
  if (all.count == 0) return;
  throw std::runtime_error(
      fmt::format("{} is {} at voxel {} of the volume, and not allowed in {} of its {} voxels; {}", name_,
                  all.value, text_of(all.first), all.count, topology.voxel_count(), refusal(outside())));
}

}  // namespace solidnoise
