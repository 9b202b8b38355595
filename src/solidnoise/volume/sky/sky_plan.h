#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "solidnoise/core/cost.h"
#include "solidnoise/volume/sky/sky_recipe.h"
#include "solidnoise/volume/volume.h"

namespace solidnoise {

// One of the different clouds of a sky, at one resolution: a volume by itself.
struct SkyCloud {
  std::string name;     // "cloud_007_2": the eighth cloud, in voxels of 4 times the finest
  int level = 0;        // voxels are 2^level times the finest
  double size = 1.0;    // of the longest side of its box, world units
  double unit = 1.0;    // world units that one of the recipe's is
  VolumeRecipe recipe;  // in units of its own: seed, voxels and band limit are set, and once they are
                        // measured the factors of its densities
};

// What stands at a point: a cloud, scaled and turned.
struct SkyInstance {
  SkyPoint point;  // with its seed
  std::size_t cloud = 0;
  double scale = 1.0;
};

// What becomes of a sky.
enum class SkyForm {
  instances,  // a file of each cloud, and where they are
  grid,       // one grid of all, in the finest voxels
};

// Which clouds a sky is made of, and where they go. Points of one seed have one cloud, of the geometric mean
// of their sizes, if these are within kSizeRatio; else as many as that takes. An instance's scale is thus
// within the ratio's root, so that extinction per world unit is right to 12 % also where a program leaves a
// scaled volume's density as it is.
//
// With lod_from a cloud's voxels are 2^k times the finest ones for the largest k where they are still
//   voxel 2^k <= d tan(lod_angle),   voxel 2^k <= size / kFewestVoxels,
// d the distance from the camera to the ball around the point's box. Recipes that may be filtered are
// (band_limit), but clouds, whose voxels are means over the edge as it is; and all levels have the factors of
// density that were measured at kMeasuredVoxels voxels along the box. So they differ by what voxels can hold,
// and by nothing else.
struct SkyPlan {
  SkyRecipe recipe;  // with the digest of the file of points
  SkyForm form = SkyForm::instances;
  std::vector<SkyCloud> clouds;  // all used
  std::vector<SkyInstance> instances;
};
inline constexpr double kSizeRatio = 1.25;
inline constexpr double kFewestVoxels = 32.0;
inline constexpr double kMeasuredVoxels = 64.0;

// Validates the recipe, and reads or scatters its points. Throws std::invalid_argument (options; also one
// grid of what makes several) and std::runtime_error (files).
SkyPlan plan_sky(const SkyRecipe& recipe, SkyForm form);

// Measures the factors of the clouds' densities, for make_sky_cloud(). Throws Cancelled.
void measure_densities(SkyPlan& plan, Progress* progress = nullptr);

// Makes a cloud: its grids stand on the origin by the middle of the box's floor, as large as it says, and
// densities of an optical depth are extinction per world unit. Throws as make_volume().
Volume make_sky_cloud(const SkyCloud& cloud, const std::string& creator, Progress* progress = nullptr);

// What it takes at most: seconds of all threads together, bytes.
Cost sky_cost(const SkyPlan& plan, int threads);

// What is to be made, as JSON.
Json describe_sky(const SkyPlan& plan, int threads);

}  // namespace solidnoise
