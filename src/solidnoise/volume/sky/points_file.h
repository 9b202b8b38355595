#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solidnoise/volume/sky/sky_point.h"

namespace solidnoise {

// The most points that a sky may have: as many instances as programs for scenes still open.
inline constexpr std::size_t kMostSkyPoints = 100'000;

// Reads points from
//   .csv  names of columns in the first line, a point in each other one, commas between:
//         x, y, z, which must be there, size, turn and seed; file and scale, which
//         points_text() adds, are passed over. Empty lines and what follows a # are, too
//   .ply  vertices with properties of the same names, as read_mesh() reads them; other
//         properties are passed over
// What a point has no number for is that of `others`. Throws std::runtime_error that names the path, line or
// vertex, and column: what cannot be read, is no number or not allowed, an unknown column, one that is
// missing or there twice, no points, more than kMostSkyPoints.
std::vector<SkyPoint> read_points(const std::filesystem::path& path, const SkyPoint& others = {});

// The text of a .csv of points, with what stands there: a file and what it is scaled by.
struct PlacedFile {
  std::string file;
  double scale = 1.0;
};
std::string points_text(const std::vector<SkyPoint>& points, const std::vector<PlacedFile>& files = {});

}  // namespace solidnoise
