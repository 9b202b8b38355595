#include "solidnoise/field/cloud_puffs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kPileStream = 0x636c6f7564;  // "cloud"
constexpr double kFullTurn = 2.0 * std::numbers::pi;

// A hill of the outline that the puffs are piled under; lengths in half widths and heights of the pile.
struct Tower {
  double x = 0.0;
  double z = 0.0;
  double height = 1.0;
  double radius = 0.6;
};

class PileMaker {
 public:
  explicit PileMaker(const PuffPile& pile)
      : pile_(pile),
        random_(derive_seed(pile.seed, kPileStream)),
        radii_{0.5 * pile.size.x, 0.5 * pile.size.z} {}

  std::vector<Puff> make() {
    raise_towers();
    for (int attempt = 0; attempt < 400 * pile_.count && size() < pile_.count; ++attempt) add_puff();
    const std::size_t large = puffs_.size();
    for (std::size_t i = 0; i < large; ++i) add_buds(puffs_[i], i);
    lean();
    fit();
    return puffs_;
  }

 private:
  int size() const { return static_cast<int>(puffs_.size()); }
  double between(double low, double high) { return low + (high - low) * random_.next_unit(); }

  void raise_towers() {
    const double turn = between(0.0, kFullTurn);
    const double off_centre = between(0.0, 0.25);
    towers_[0] = {off_centre * std::cos(turn), off_centre * std::sin(turn), 1.0, 0.5};
    for (std::size_t i = 1; i < towers_.size(); ++i) {
      const double angle = turn + kFullTurn * (static_cast<double>(i) + between(-0.25, 0.25)) / 4.0;
      const double distance = between(0.4, 0.7);
      const double height = between(0.3, 0.75);
      const double radius = between(0.3, 0.45);
      towers_[i] = {distance * std::cos(angle), distance * std::sin(angle), height, radius};
    }
  }

  // The outline's height above a place of the unit disc, 0 to 1.
  double height(double x, double z) const {
    double height = 0.34 * (1.0 - x * x - z * z);
    for (const Tower& tower : towers_) {
      const double from_tower = std::hypot(x - tower.x, z - tower.z) / tower.radius;
      height = std::max(height, tower.height * (1.0 - from_tower * from_tower));
    }
    return height;
  }

  // Tries to put one large puff at random. The first stands in the middle of the highest tower.
  void add_puff() {
    const double angle = between(0.0, kFullTurn);
    const double distance = std::sqrt(between(0.0, 1.0));
    const double level = std::max(0.0, between(-0.5, 1.0));
    const double growth = between(0.7, 1.25);
    const double x = puffs_.empty() ? towers_[0].x : distance * std::cos(angle);
    const double z = puffs_.empty() ? towers_[0].z : distance * std::sin(angle);
    const double top = height(x, z) * pile_.size.y;
    const double flank = std::hypot(x, z);
    const double widest = 0.27 * std::min({pile_.size.x, pile_.size.y * 1.6, pile_.size.z});
    const double radius = std::min(growth * widest * (1.0 - 0.5 * flank), 0.9 * top);
    if (radius < 0.3 * widest) return;
    const double low = 0.05 * radius;
    const Puff puff{{x * radii_[0], low + level * std::max(0.0, top - radius - low), z * radii_[1]}, radius};
    if (fits(puff)) puffs_.push_back(puff);
  }

  // Whether a puff overlaps another one well, but is not much of the same.
  bool fits(const Puff& puff) const {
    bool touches = puffs_.empty();
    for (const Puff& other : puffs_) {
      const double distance = glm::distance(puff.centre, other.centre);
      if (distance < 0.5 * std::max(puff.radius, other.radius) + 0.12 * std::min(puff.radius, other.radius))
        return false;
      if (distance < 0.75 * (puff.radius + other.radius)) touches = true;
    }
    return touches;
  }

  // Buds on the upper and outer side of a large puff, where they are not inside of another one.
  void add_buds(Puff parent, std::size_t index) {
    constexpr int kBuds = 14;
    const double turn = between(0.0, kFullTurn);
    for (int i = 0; i < kBuds; ++i) {
      const double up = 1.0 - 1.35 * (i + between(0.0, 1.0)) / kBuds;
      const double angle = turn + i * std::numbers::phi * kFullTurn + between(-0.5, 0.5);
      const double size = between(0.26, 0.52);
      const double out = std::sqrt(1.0 - up * up);
      const Vec<3> direction{out * std::cos(angle), up, out * std::sin(angle)};
      const Puff bud{parent.centre + direction * (parent.radius * (1.02 - 0.45 * size)),
                     parent.radius * size};
      if (bud.centre.y > 0.0 && shows(bud, index)) puffs_.push_back(bud);
    }
  }

  bool shows(const Puff& bud, std::size_t parent) const {
    for (std::size_t i = 0; i < puffs_.size(); ++i) {
      const double outside = glm::distance(bud.centre, puffs_[i].centre) - puffs_[i].radius;
      if (i != parent && outside < -0.4 * bud.radius) return false;
    }
    return true;
  }

  void lean() {
    const double angle = between(0.0, kFullTurn);
    const double shift = pile_.lean * between(0.5, 1.0);
    for (Puff& puff : puffs_) {
      puff.centre.x += shift * puff.centre.y * std::cos(angle);
      puff.centre.z += shift * puff.centre.y * std::sin(angle);
    }
  }

  // Moves the pile to the middle of its box and scales it until it touches the sides or the top.
  void fit() {
    Vec<3> low{1e300};
    Vec<3> high{-1e300};
    for (const Puff& puff : puffs_) {
      low = glm::min(low, puff.centre - puff.radius);
      high = glm::max(high, puff.centre + puff.radius);
    }
    low.y = 0.0;
    const Vec<3> room = pile_.size / (high - low);
    const double scale = std::min({room.x, room.y, room.z});
    const Vec<3> middle{0.5 * (low.x + high.x), 0.0, 0.5 * (low.z + high.z)};
    for (Puff& puff : puffs_) puff = {(puff.centre - middle) * scale, puff.radius * scale};
  }

  const PuffPile& pile_;
  RandomStream random_;
  std::array<double, 2> radii_;
  std::array<Tower, 4> towers_;
  std::vector<Puff> puffs_;
};

}  // namespace

std::vector<Puff> pile_puffs(const PuffPile& pile) {
  return PileMaker(pile).make();
}

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
