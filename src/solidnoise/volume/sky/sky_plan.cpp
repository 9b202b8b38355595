#include "solidnoise/volume/sky/sky_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/sky/sky_grid.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/volume_cost.h"

namespace solidnoise {
namespace {

double longest_side(const Box<3>& box) {
  const Vec<3> size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

std::vector<SkyPoint> points_of(SkyRecipe& recipe) {
  if (auto* const file = std::get_if<PointsFile>(&recipe.points)) {
    std::vector<SkyPoint> points = read_points(file->file, {.size = file->size});
    note_digest(file->file, "--points", file->digest);
    return points;
  }
  return scatter(std::get<ScatteredPoints>(recipe.points), recipe.cloud.up);
}

// The indices of points, the largest first; equal ones in their order.
std::vector<std::size_t> by_size(const std::vector<SkyPoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].size > points[b].size; });
  return order;
}

void give_seeds(const SkyRecipe& recipe, std::vector<SkyPoint>& points) {
  std::vector<std::size_t> seedless = by_size(points);
  std::erase_if(seedless, [&](std::size_t i) { return points[i].seed.has_value(); });
  const auto kinds = static_cast<std::size_t>(recipe.kinds);
  for (std::size_t rank = 0; rank < seedless.size(); ++rank) {
    points[seedless[rank]].seed = seed_of(recipe.cloud.noise) + rank * kinds / seedless.size();
  }
}

// Points that share a cloud, and its size.
struct Group {
  std::vector<std::size_t> points;
  double size = 1.0;
};

// The group with the largest point first.
std::vector<Group> groups_of(const std::vector<SkyPoint>& points) {
  std::map<std::uint64_t, std::size_t> latest;  // group of each seed
  std::vector<Group> groups;
  for (const std::size_t i : by_size(points)) {
    const auto [found, is_new] = latest.try_emplace(*points[i].seed, groups.size());
    if (!is_new) {
      const double largest = points[groups[found->second].points.front()].size;
      if (points[i].size * kSizeRatio < largest) found->second = groups.size();
    }
    if (found->second == groups.size()) groups.emplace_back();
    groups[found->second].points.push_back(i);
  }
  for (Group& group : groups)
    group.size = std::sqrt(points[group.points.front()].size * points[group.points.back()].size);
  return groups;
}

// Of the voxels of the cloud at a point.
int level_of(const SkyRecipe& recipe, const SkyPoint& point) {
  if (!recipe.lod_from) return 0;
  const Box<3>& box = recipe.cloud.box;
  const double unit = point.size / longest_side(box);
  const int up = vertical_axis(recipe.cloud);
  Vec<3> centre(point.x, point.y, point.z);
  centre[up] += 0.5 * unit * (box.upper[up] - box.lower[up]);
  const double ball = 0.5 * unit * glm::distance(box.upper, box.lower);
  const double distance = std::max(0.0, glm::distance(centre, *recipe.lod_from) - ball);
  const double largest =
      std::min(distance * std::tan(recipe.lod_angle * kPi / 180.0), point.size / kFewestVoxels);
  constexpr double kMostLevels = 40.0;
  if (largest < recipe.voxel) return 0;
  return static_cast<int>(std::min(kMostLevels, std::floor(std::log2(largest / recipe.voxel))));
}

// Whether to filter what voxels cannot hold. Not of a cloud: lobes that are filtered out would take their
// height with them, and with it mass; voxels are means over its edge as it is.
bool is_band_limited(const VolumeRecipe& recipe) {
  const std::vector<VolumeRecipe> singles = recipes_of_grids(recipe);
  return std::all_of(singles.begin(), singles.end(), [](const VolumeRecipe& single) {
    return may_band_limit(single) && !std::holds_alternative<CloudShaping>(single.shaping);
  });
}

void require_one_grid(const VolumeRecipe& cloud) {
  if (is_scalar(cloud)) return;
  throw std::invalid_argument(
      "cloud makes several grids, or vectors; one grid of a sky is of clouds that are one grid of floats");
}

SkyCloud cloud_of(const SkyRecipe& recipe, double size, std::uint64_t seed, int level) {
  SkyCloud cloud;
  cloud.level = level;
  cloud.size = size;
  cloud.unit = size / longest_side(recipe.cloud.box);
  cloud.recipe = recipe.cloud;
  std::visit([seed](auto& options) { options.seed = seed; }, cloud.recipe.noise.noise);
  cloud.recipe.voxel = recipe.voxel * std::exp2(level) / cloud.unit;
  cloud.recipe.band_limit = is_band_limited(recipe.cloud);
  return cloud;
}

}  // namespace

SkyPlan plan_sky(const SkyRecipe& recipe, SkyForm form) {
  recipe.validate();
  SkyPlan plan{recipe, form, {}, {}};
  SkyRecipe seen = recipe;
  if (form == SkyForm::grid) {
    require_one_grid(recipe.cloud);
    seen.lod_from.reset();
  }
  std::vector<SkyPoint> points = points_of(plan.recipe);
  give_seeds(recipe, points);
  plan.instances.resize(points.size());
  const std::vector<Group> groups = groups_of(points);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::map<int, std::size_t> clouds;  // by their levels
    for (const std::size_t i : groups[g].points) {
      const int level = level_of(seen, points[i]);
      const auto [found, is_new] = clouds.try_emplace(level, plan.clouds.size());
      if (is_new) {
        plan.clouds.push_back(cloud_of(recipe, groups[g].size, *points[i].seed, level));
        plan.clouds.back().name = fmt::format("cloud_{:03}_{}", g, level);
      }
      plan.instances[i] = {points[i], found->second, points[i].size / groups[g].size};
    }
  }
  return plan;
}

namespace {

// Of clouds that differ by their voxels alone.
using DensityKey = std::tuple<std::uint64_t, double>;

DensityKey density_key(const SkyCloud& cloud) {
  return {seed_of(cloud.recipe.noise), cloud.size};
}

// In the voxels that densities are measured in.
VolumeRecipe measured_recipe(VolumeRecipe recipe) {
  recipe.voxel = longest_side(recipe.box) / kMeasuredVoxels;
  return recipe;
}

}  // namespace

void measure_densities(SkyPlan& plan, Progress* progress) {
  std::map<DensityKey, std::vector<std::optional<double>>> measured;
  for (std::size_t c = 0; c < plan.clouds.size(); ++c) {
    throw_if_cancelled(progress);
    SkyCloud& cloud = plan.clouds[c];
    const std::vector<VolumeRecipe> singles = recipes_of_grids(cloud.recipe);
    const auto [found, is_new] = measured.try_emplace(density_key(cloud));
    for (std::size_t i = 0; i < singles.size(); ++i) {
      if (is_new) {
        const VolumeRecipe coarse = measured_recipe(singles[i]);
        found->second.push_back(measures_density(coarse) ? measure_density_factor(coarse, plan_volume(coarse))
                                                         : std::nullopt);
      }
      DensityScale& density = grid_of(cloud.recipe, i).density;
      if (!found->second[i]) continue;
      density.factor = *found->second[i] / (density.peak ? 1.0 : cloud.unit);
    }
    if (progress != nullptr) progress->advance(c + 1, plan.clouds.size());
  }
}

Volume make_sky_cloud(const SkyCloud& cloud, const std::string& creator, Progress* progress) {
  Volume volume = make_volume(cloud.recipe, plan_volume(cloud.recipe), creator, progress);
  const Box<3>& box = cloud.recipe.box;
  Vec<3> foot = 0.5 * (box.lower + box.upper);
  const int up = vertical_axis(cloud.recipe);
  foot[up] = box.lower[up];
  for (MeasuredGrid& measured : volume.grids) {
    openvdb::math::Transform& transform = measured.grid->transform();
    transform.postScale(cloud.unit);
    transform.postTranslate(-cloud.unit * openvdb::Vec3d(foot.x, foot.y, foot.z));
  }
  return volume;
}

namespace {

// What one cloud takes, and its kept_share().
struct CloudCost {
  Cost cost;
  double kept = 1.0;
};

// Of clouds whose voxels are within a tenth of each other's the costs are those of the one with the finest.
class CloudCosts {
 public:
  explicit CloudCosts(int threads) : threads_(threads) {}

  const CloudCost& of(const VolumeRecipe& recipe) {
    const int step = static_cast<int>(std::floor(8.0 * std::log2(*recipe.voxel)));
    const auto [found, is_new] = costs_.try_emplace(step);
    if (is_new) {
      VolumeRecipe finest = recipe;
      finest.voxel = std::exp2(step / 8.0);
      finest.band_limit = false;  // no less than with it
      VolumePlan plan = plan_volume(finest);
      const double kept = kept_share(finest, plan);
      plan.memory = plan.mask_memory + static_cast<std::uint64_t>(kept * static_cast<double>(plan.memory));
      found->second = {volume_cost(finest, plan, threads_), kept};
    }
    return found->second;
  }

 private:
  int threads_;
  std::map<int, CloudCost> costs_;
};

}  // namespace

Cost sky_cost(const SkyPlan& plan, int threads) {
  constexpr double kBytesPerPoint = 1000.0;  // of the plan, and of the text of a scene
  CloudCosts costs(threads);
  Cost total;
  std::vector<double> kept;
  std::set<DensityKey> measured;
  for (const SkyCloud& cloud : plan.clouds) {
    if (measured.insert(density_key(cloud)).second)
      total.seconds += costs.of(measured_recipe(cloud.recipe)).cost.seconds;
    const CloudCost& one = costs.of(cloud.recipe);
    kept.push_back(one.kept);
    total.seconds += one.cost.seconds;
    total.bytes = std::max(total.bytes, one.cost.bytes);
  }
  total.bytes += kBytesPerPoint * static_cast<double>(plan.instances.size());
  if (plan.form == SkyForm::grid) total += placing_cost(plan, kept);
  return total;
}

Json describe_sky(const SkyPlan& plan, int threads) {
  Json json = Json::object();
  json["points"] = plan.instances.size();
  std::vector<std::size_t> uses(plan.clouds.size());
  for (const SkyInstance& instance : plan.instances) ++uses[instance.cloud];
  for (std::size_t i = 0; i < plan.clouds.size(); ++i) {
    const SkyCloud& cloud = plan.clouds[i];
    json["clouds"].push_back({{"name", cloud.name},
                              {"seed", seed_of(cloud.recipe.noise)},
                              {"size", cloud.size},
                              {"voxel", *cloud.recipe.voxel * cloud.unit},
                              {"instances", uses[i]}});
  }
  const Cost cost = sky_cost(plan, threads);
  json["cost"] = {{"seconds_of_one_core", cost.seconds}, {"threads", threads}, {"memory_bytes", cost.bytes}};
  json["recipe"] = to_json(plan.recipe);
  return json;
}

}  // namespace solidnoise
