#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/volume/sky/points_file.h"

namespace solidnoise {

// Points that are thrown at random on a level rectangle, the largest cloud first: each lands where a map of
// the density lets it, no nearer to another than their sizes allow. There are exactly `count`, and their
// sizes are the quantiles (k + 1/2) / count of the distribution
//   p(s) ~ s^-exponent,  smallest <= s <= largest,
// as those of cumuli are about (exponents of 1.5 to 2.5), so that no sky has too many large ones by chance.
struct ScatteredPoints {
  int count = 500;
  std::array<double, 4> area{-10000.0, -10000.0, 10000.0, 10000.0};  // world units: two corners, along x and
                                                                     // z where y is up, else along x and y
  double altitude = 1000.0;      // of the clouds' floors, world units along the up axis
  double altitude_spread = 0.0;  // how far they are off at most, world units; at least 0
  double smallest = 400.0;       // sizes, world units; > 0
  double largest = 2400.0;
  double exponent = 2.0;
  double spacing = 0.75;  // least distance of two clouds' middles along the ground, in means of their sizes
  std::optional<Layer> density{};  // clamped to 0..1, the chance that a cloud stays where it falls, looked up
                                   // at the altitude
  std::uint64_t seed = 0;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const ScatteredPoints&, const ScatteredPoints&) = default;
};

constexpr auto fields_of(std::type_identity<ScatteredPoints>) {
  using Points = ScatteredPoints;
  return list_fields(
      field("count", &Points::count, between(1, kMostSkyPoints), "", "Number of clouds"),
      field("area", &Points::area, kSkyPlaces, "world units",
            "Where they are: two corners along x and z, or along x and y where z is up"),
      field("altitude", &Points::altitude, kSkyPlaces, "world units", "Of the clouds' floors"),
      field("altitude_spread", &Points::altitude_spread, between(0.0, kFarthestPoint), "world units",
            "How far floors are off the altitude at most"),
      field("smallest", &Points::smallest, kSkySizes, "world units", "Size of the smallest cloud"),
      field("largest", &Points::largest, kSkySizes, "world units", "Size of the largest"),
      field("exponent", &Points::exponent, between(-8.0, 8.0), "",
            "Of sizes, whose frequency falls with this power"),
      field("spacing", &Points::spacing, between(0.0, 1000.0), "sizes",
            "Least distance of two clouds' middles, in means of their sizes"),
      field("density", &Points::density,
            "Clamped to 0..1, the chance that a cloud stays where it falls; left out, 1"),
      field("seed", &Points::seed, "Another seed makes another sky"));
}

// The points, the largest first, without seeds of their own; the same for any number of threads. Throws
// std::invalid_argument for options, and where there is no room for all of them.
std::vector<SkyPoint> scatter(const ScatteredPoints& how, UpAxis up);

}  // namespace solidnoise
