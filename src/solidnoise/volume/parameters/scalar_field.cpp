#include "solidnoise/volume/parameters/scalar_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <openvdb/tools/Interpolation.h>
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

ScalarField::ScalarField(ParameterGrid& source, const std::string& flag, const ParameterRange& range)
    : grid_(read_float_grid(source.source, flag)),
      map_(source.map),
      by_ratio_(range.without_lowest),
      range_(range),
      name_(fmt::format("{}: grid '{}'", source.source.file, grid_->getName())) {
  if (grid_->activeVoxelCount() == 0) throw std::runtime_error(name_ + " has no active voxels");
  require_allowed_values();
}

float ScalarField::mapped(float value) const {
  if (!map_) return value;
  if (!std::isfinite(value)) return std::numeric_limits<float>::quiet_NaN();
  const double t = std::clamp((static_cast<double>(value) - map_->low) / (map_->high - map_->low), 0.0, 1.0);
  if (by_ratio_) return static_cast<float>(map_->at_low * std::pow(map_->at_high / map_->at_low, t));
  return static_cast<float>((1.0 - t) * map_->at_low + t * map_->at_high);
}

bool ScalarField::allows(float value) const {
  return map_ ? std::isfinite(value) : range_.allows(value);
}

std::string ScalarField::allowed() const {
  return map_ ? "must be finite" : fmt::format("must be {}", range_.allowed);
}

float ScalarField::raw_at(const openvdb::FloatGrid::ConstUnsafeAccessor& accessor,
                          const Vec<3>& position) const {
  const openvdb::Vec3d index =
      grid_->transform().worldToIndex(openvdb::Vec3d(position.x, position.y, position.z));
  return openvdb::tools::BoxSampler::sample(accessor, index);
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
  if (refused.count == 0) return;
  throw std::runtime_error(fmt::format("{} is {} at voxel {}, and not allowed in {} of its {} voxels; it {}",
                                       name_, refused.value, text_of(refused.first), refused.count,
                                       grid_->activeVoxelCount(), allowed()));
}

void ScalarField::sample(std::span<const Vec<3>> positions, std::span<float> values) const {
  const auto accessor = grid_->getConstUnsafeAccessor();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec<3>& p = positions[i];
    const float value = raw_at(accessor, p);
    if (!allows(value)) {
      throw std::runtime_error(
          fmt::format("{} is {} at ({:.6g}, {:.6g}, {:.6g}); it {}, and outside of its active voxels its "
                      "background, {}, counts",
                      name_, value, p.x, p.y, p.z, allowed(), grid_->background()));
    }
    values[i] = mapped(value);
  }
}

void ScalarField::require_allowed_at(const Topology& topology) const {
  std::vector<const openvdb::MaskTree::LeafNodeType*> leaves;
  topology.mask->getNodes(leaves);
  std::vector<Refused> refused(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t leaf) {
    const auto accessor = grid_->getConstUnsafeAccessor();
    for (auto voxel = leaves[leaf]->cbeginValueOn(); voxel; ++voxel) {
      const Coord index = voxel.getCoord();
      const float value = raw_at(accessor, topology.frame.bounds({index, index}).lower);
      if (!allows(value)) refused[leaf].add(index, value);
    }
  });
  Refused all;
  for (const Refused& of_leaf : refused) all.add(of_leaf);
  if (all.count == 0) return;
  throw std::runtime_error(
      fmt::format("{} is {} at voxel {} of the volume, and not allowed in {} of its {} voxels; it {}, and "
                  "outside of its active voxels its background, {}, counts",
                  name_, all.value, text_of(all.first), all.count, topology.voxel_count(), allowed(),
                  grid_->background()));
}

}  // namespace solidnoise
