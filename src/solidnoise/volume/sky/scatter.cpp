#include "solidnoise/volume/sky/scatter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/volume/recipe_field.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kStandStream = 0x7374616e64;  // "stand"
constexpr std::uint64_t kThrowStream = 0x7468726f77;  // "throw"

// Throws of one cloud before there is no room for it; the density is looked up for a batch of them.
constexpr int kThrowsPerBatch = 64;
constexpr int kMostBatches = 64;

// Quantile of the sizes' distribution, 0 < part < 1.
double size_at(const ScatteredPoints& how, double part) {
  const double power = 1.0 - how.exponent;
  if (std::abs(power) < 1e-9) return how.smallest * std::pow(how.largest / how.smallest, part);
  const double low = std::pow(how.smallest, power);
  const double high = std::pow(how.largest, power);
  return std::pow(low + part * (high - low), 1.0 / power);
}

// What stands already, in square cells as wide as two clouds may have to be apart.
class StandingClouds {
 public:
  StandingClouds(double spacing, double largest)
      : spacing_(spacing), cell_(std::max(spacing * largest, 1e-9)) {}

  bool has_room(const Vec<2>& place, double size) const {
    if (spacing_ == 0.0) return true;
    const auto [i, j] = cell_of(place);
    for (std::int64_t di = -1; di <= 1; ++di) {
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        const auto cell = cells_.find({i + di, j + dj});
        if (cell == cells_.end()) continue;
        for (const Cloud& other : cell->second) {
          const double apart = spacing_ * 0.5 * (size + other.size);
          if (squared_length<2>(place - other.place) < apart * apart) return false;
        }
      }
    }
    return true;
  }
  void add(const Vec<2>& place, double size) { cells_[cell_of(place)].push_back({place, size}); }

 private:
  struct Cloud {
    Vec<2> place;
    double size;
  };
  using Cell = std::pair<std::int64_t, std::int64_t>;

  Cell cell_of(const Vec<2>& place) const {
    return {static_cast<std::int64_t>(std::floor(place.x / cell_)),
            static_cast<std::int64_t>(std::floor(place.y / cell_))};
  }

  double spacing_;
  double cell_;
  std::map<Cell, std::vector<Cloud>> cells_;
};

// A place along the ground and a height in the world.
Vec<3> in_world(const Vec<2>& place, double height, UpAxis up) {
  return up == UpAxis::y ? Vec<3>(place.x, height, place.y) : Vec<3>(place.x, place.y, height);
}

FieldPtr density_field(const ScatteredPoints& how) {
  if (!how.density) return nullptr;
  VolumeRecipe map;
  map.layers = {*how.density};
  const RecipeField field(map);
  return field.on_voxels(field.frame()).field;
}

class Thrower {
 public:
  Thrower(const ScatteredPoints& how, UpAxis up)
      : how_(how), up_(up), density_(density_field(how)), standing_(how.spacing, how.largest) {}

  // Cloud k of `count`; false if there is no room.
  bool add(int k) {
    const auto key = static_cast<std::uint64_t>(k);
    RandomStream stand(derive_seed(derive_seed(how_.seed, kStandStream), key));
    const double turn = 360.0 * stand.next_unit();
    const double height = how_.altitude + how_.altitude_spread * (2.0 * stand.next_unit() - 1.0);
    const double size = size_at(how_, 1.0 - (k + 0.5) / how_.count);
    RandomStream throws(derive_seed(derive_seed(how_.seed, kThrowStream), key));
    for (int batch = 0; batch < kMostBatches; ++batch) {
      const std::optional<Vec<2>> place = first_that_stays(throws, size);
      if (!place) continue;
      standing_.add(*place, size);
      const Vec<3> at = in_world(*place, height, up_);
      points_.push_back({at.x, at.y, at.z, size, turn});
      return true;
    }
    return false;
  }

  std::vector<SkyPoint> take() { return std::move(points_); }

 private:
  std::optional<Vec<2>> first_that_stays(RandomStream& random, double size) const {
    std::vector<Vec<2>> places;
    std::vector<Vec<3>> positions;
    std::vector<double> chances;
    for (int i = 0; i < kThrowsPerBatch; ++i) {
      const double along = random.next_unit();
      const double across = random.next_unit();
      chances.push_back(random.next_unit());
      places.emplace_back(how_.area[0] + along * (how_.area[2] - how_.area[0]),
                          how_.area[1] + across * (how_.area[3] - how_.area[1]));
      positions.push_back(in_world(places.back(), how_.altitude, up_));
    }
    std::vector<float> density(positions.size(), 1.0f);
    if (density_) density_->evaluate(Points<3>{positions}, {density, {}});
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (chances[i] < static_cast<double>(density[i]) && standing_.has_room(places[i], size))
        return places[i];
    }
    return std::nullopt;
  }

  const ScatteredPoints& how_;
  UpAxis up_;
  FieldPtr density_;
  StandingClouds standing_;
  std::vector<SkyPoint> points_;
};

}  // namespace

void ScatteredPoints::validate() const {
  require_fields(*this);
  for (const int side : {0, 1}) {
    const auto i = static_cast<std::size_t>(side);
    if (area[i] < area[i + 2]) continue;
    throw std::invalid_argument(
        fmt::format("area is {} to {} along its {} side; its upper corner must lie beyond its lower one",
                    area[i], area[i + 2], side == 0 ? "first" : "second"));
  }
  if (largest < smallest) {
    throw std::invalid_argument(
        fmt::format("largest is {}; it must be at least smallest, {} (world units)", largest, smallest));
  }
  if (density) validate_layer(*density, {NoiseRecipe{}, {}}, "density");
}

std::vector<SkyPoint> scatter(const ScatteredPoints& how, UpAxis up) {
  how.validate();
  Thrower thrower(how, up);
  for (int k = 0; k < how.count; ++k) {
    if (thrower.add(k)) continue;
    throw std::invalid_argument(fmt::format(
        "count is {}; there is room for {} of these sizes: make spacing smaller, or the area larger",
        how.count, k));
  }
  return thrower.take();
}

}  // namespace solidnoise
