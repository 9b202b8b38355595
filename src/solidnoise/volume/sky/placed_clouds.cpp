#include "solidnoise/volume/sky/placed_clouds.h"

#include <algorithm>

#include <glm/common.hpp>
#include <openvdb/tools/Interpolation.h>

#include "solidnoise/core/bounds.h"

namespace solidnoise {
namespace {

bool contains(const Box<3>& box, const Vec<3>& p) {
  return glm::max(box.lower, p) == p && glm::min(box.upper, p) == p;
}

// As overlap(), where one of them may be a point.
bool touch(const Box<3>& a, const Box<3>& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  }
  return true;
}

}  // namespace

PlacedClouds::PlacedClouds(const std::vector<PlacedCloud>& clouds) {
  for (const PlacedCloud& cloud : clouds) {
    const openvdb::Mat4d to_own_world = cloud.grid->transform().baseMap()->getAffineMap()->getMat4();
    clouds_.push_back({cloud.grid, (to_own_world * cloud.to_world).inverse(), cloud.bounds});
  }
}

void PlacedClouds::evaluate(const Points<3>& points, const Samples<3>& samples) const {
  std::fill(samples.values.begin(), samples.values.end(), 0.0f);
  if (points.size() == 0) return;
  const Box<3> around = bounds_of(points.positions);
  for (const Cloud& cloud : clouds_) {
    if (!touch(cloud.bounds, around)) continue;
    const openvdb::FloatGrid::ConstUnsafeAccessor values(cloud.grid->tree());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec<3>& p = points.positions[i];
      if (!contains(cloud.bounds, p)) continue;
      const openvdb::Vec3d index = openvdb::Vec3d(p.x, p.y, p.z) * cloud.to_index;
      samples.values[i] += openvdb::tools::BoxSampler::sample(values, index);
    }
  }
}

bool PlacedClouds::empty(const Box<3>& box) const {
  return std::none_of(clouds_.begin(), clouds_.end(),
                      [&](const Cloud& cloud) { return touch(cloud.bounds, box); });
}

bool overlap(const Box<3>& a, const Box<3>& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] >= b.upper[axis] || b.lower[axis] >= a.upper[axis]) return false;
  }
  return true;
}

}  // namespace solidnoise
