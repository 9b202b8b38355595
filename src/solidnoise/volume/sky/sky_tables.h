#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "solidnoise/core/fields.h"
#include "solidnoise/volume/sky/sky_recipe.h"

namespace solidnoise {

// In the order of the alternatives of SkyPoints.
inline constexpr std::array<std::string_view, 2> kSkyPointsTypes{"scattered", "file"};

constexpr auto fields_of(std::type_identity<PointsFile>) {
  using Points = PointsFile;
  return list_fields(
      field("file", &Points::file, "A .csv or .ply of points: x, y, z, size, turn, seed").without_flag(),
      field("digest", &Points::digest, "Of the file, where the sky exists already")
          .written_if([](const Points& points) { return !points.digest.empty(); })
          .without_flag(),
      field("size", &Points::size, kSkySizes, "world units", "Of points that have none"));
}

constexpr auto fields_of(std::type_identity<SkyRecipe>) {
  using Sky = SkyRecipe;
  return list_fields(
      field("description", &Sky::description, "For people; changes nothing")
          .written_if([](const Sky& sky) { return !sky.description.empty(); })
          .without_flag(),
      field("cloud", &Sky::cloud, "The volume that is placed, as large as its point says"),
      field("points", &Sky::points, "Where clouds stand: scattered, or those of a file"),
      field("kinds", &Sky::kinds, between(1, 4096), "", "Different clouds among points without a seed"),
      field("voxel", &Sky::voxel, kSkySizes, "world units", "Size of a voxel of the finest clouds"),
      field("lod_from", &Sky::lod_from, kSkyPlaces, "world units",
            "A camera: clouds that are far from it get voxels 2, 4, 8, ... times as large"),
      field("lod_angle", &Sky::lod_angle, between(1e-4, 90.0), "degrees",
            "That such a voxel may span as seen from there"));
}

}  // namespace solidnoise
