#pragma once

#include <optional>
#include <string>
#include <variant>

#include "solidnoise/core/vec.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/sky/scatter.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// Points from a file; see read_points().
struct PointsFile {
  std::string file{};    // .csv or .ply
  std::string digest{};  // file_digest() of it, where the sky exists already; empty: any file will do
  double size = 1000.0;  // of points that have none, world units; > 0

  friend bool operator==(const PointsFile&, const PointsFile&) = default;
};

using SkyPoints = std::variant<ScatteredPoints, PointsFile>;

// A sky: a volume's recipe that is placed at many points, each time with another seed, size and turn. It is a
// recipe of its own kind, and not one more key of a volume's: that describes the grids of one file, with all
// that may be done with one (parts, sequences, --on); a sky takes it as it is, whatever its noise and
// shaping, as fields take fields, and what it makes are such files, and where they go.
//
// Of many points few are different: a point that has no seed gets that of one of `kinds`, the largest points
// those of the first, so that one file serves points of nearly one size (see SkyPlan).
struct SkyRecipe {
  std::string description{};  // for people; changes nothing
  VolumeRecipe cloud{};       // what is placed. Its box is made as large as a point says, and stands on the
                              // point by the middle of its floor; its seed is that of the first kind
  SkyPoints points{};
  int kinds = 24;  // different clouds among the points that have no seed

  double voxel = 8.0;                // of the finest clouds, world units; > 0
  std::optional<Vec<3>> lod_from{};  // a camera, world units: clouds that are far from it have larger voxels,
                                     // by powers of 2; none: all have the finest
  double lod_angle = 0.1;            // that a voxel may span as seen from there, degrees; > 0

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

// The form of a sky: {"solidnoise": 2, "cloud": {a volume's keys}, "points": {"type": "scattered", ...} or
// {"type": "file", "file": "points.csv"}, "kinds": 24, "voxel": 8, "lod_from": [0, 100, 0], "lod_angle": 0.1}
Json to_json(const SkyRecipe& recipe);

// Throws std::invalid_argument as volume_recipe_from_json() does.
SkyRecipe sky_recipe_from_json(const Json& json);

Json sky_recipe_schema();

}  // namespace solidnoise
