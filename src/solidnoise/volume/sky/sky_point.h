#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "solidnoise/core/fields.h"

namespace solidnoise {

// Where clouds may stand, how large they and their voxels may be: world units.
inline constexpr double kFarthestPoint = 1e8;
inline constexpr Interval kSkyPlaces = between(-kFarthestPoint, kFarthestPoint);
inline constexpr Interval kSkySizes = between(1e-3, kFarthestPoint);

// Where a cloud stands in a sky.
struct SkyPoint {
  double x = 0.0;  // of the middle of its floor, world units
  double y = 0.0;
  double z = 0.0;
  double size = 1000.0;                 // of the longest side of its box, world units; > 0
  double turn = 0.0;                    // about the up axis, degrees, against the clock as seen from above
  std::optional<std::uint64_t> seed{};  // of its noise; none: of one of the sky's kinds

  friend bool operator==(const SkyPoint&, const SkyPoint&) = default;
};

// Also the columns of files of points.
constexpr auto fields_of(std::type_identity<SkyPoint>) {
  using Point = SkyPoint;
  return list_fields(field("x", &Point::x, kSkyPlaces, "world units", "Of the middle of the cloud's floor"),
                     field("y", &Point::y, kSkyPlaces, "world units", "The same"),
                     field("z", &Point::z, kSkyPlaces, "world units", "The same"),
                     field("size", &Point::size, kSkySizes, "world units", "Of the longest side of its box"),
                     field("turn", &Point::turn, kSkyPlaces, "degrees",
                           "About the up axis, against the clock as seen from above"),
                     field("seed", &Point::seed, "Of its noise"));
}

}  // namespace solidnoise
