#include "solidnoise/field/cloud_union.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

constexpr double kReach = 3.0;  // where w ends

// Distances from a puff's surface to the nearest and the farthest point of a box.
double nearest(const Puff& puff, const Box<3>& box) {
  return glm::distance(puff.centre, glm::clamp(puff.centre, box.lower, box.upper)) - puff.radius;
}
double farthest(const Puff& puff, const Box<3>& box) {
  return glm::length(glm::max(glm::abs(puff.centre - box.lower), glm::abs(puff.centre - box.upper))) -
         puff.radius;
}

}  // namespace

PuffUnion::PuffUnion(std::vector<Puff> puffs, double rounding)
    : puffs_(std::move(puffs)), rounding_(rounding) {}

double PuffUnion::lower_bound(const Box<3>& box) const {
  double first = std::numeric_limits<double>::infinity();
  for (const Puff& puff : puffs_) first = std::min(first, nearest(puff, box));
  return first - rounding_ * std::log(static_cast<double>(puffs_.size()));
}

PuffUnion PuffUnion::within(const Box<3>& box) const {
  double first = std::numeric_limits<double>::infinity();
  for (const Puff& puff : puffs_) first = std::min(first, farthest(puff, box));
  // Distances are evaluated in floats: leave room for their rounding.
  const double last = first + kReach * rounding_ * 1.01 + 1e-5 * glm::length(box.upper - box.lower);
  std::vector<Puff> kept;
  for (const Puff& puff : puffs_) {
    if (nearest(puff, box) <= last) kept.push_back(puff);
  }
  return PuffUnion(std::move(kept), rounding_);
}

void PuffUnion::evaluate(const std::array<std::span<const float>, 3>& positions,
                         std::span<float> distances) const {
  const std::size_t count = distances.size();
  const float k = static_cast<float>(rounding_);
  const float slope = static_cast<float>(1.0 / (kReach * rounding_));
  std::vector<float> apart(count * puffs_.size());
  std::fill(distances.begin(), distances.end(), std::numeric_limits<float>::max());
  float* to_puff = apart.data();
  for (const Puff& puff : puffs_) {
    const auto cx = static_cast<float>(puff.centre.x);
    const auto cy = static_cast<float>(puff.centre.y);
    const auto cz = static_cast<float>(puff.centre.z);
    const auto radius = static_cast<float>(puff.radius);
    for (std::size_t i = 0; i < count; ++i) {
      const float x = positions[0][i] - cx;
      const float y = positions[1][i] - cy;
      const float z = positions[2][i] - cz;
      to_puff[i] = std::sqrt(x * x + y * y + z * z) - radius;
      distances[i] = std::min(distances[i], to_puff[i]);
    }
    to_puff += count;
  }
  std::vector<float> sum(count, 0.0f);
  to_puff = apart.data();
  for (std::size_t puff = 0; puff < puffs_.size(); ++puff, to_puff += count) {
    for (std::size_t i = 0; i < count; ++i) {
      const float w = std::max(0.0f, 1.0f - (to_puff[i] - distances[i]) * slope);
      sum[i] += w * w * w;
    }
  }
  for (std::size_t i = 0; i < count; ++i) distances[i] -= k * std::log(sum[i]);
}

}  // namespace solidnoise
