#include "solidnoise/volume/sky/sky_grid.h"

#include <cmath>
#include <memory>
#include <vector>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/sky/placed_clouds.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

// A turn against the clock about the up axis as seen from above, for rows of coordinates.
openvdb::Mat4d turn_matrix(double degrees, UpAxis up) {
  const double c = std::cos(degrees * kPi / 180.0);
  const double s = std::sin(degrees * kPi / 180.0);
  const int first = up == UpAxis::y ? 2 : 0;
  const int second = up == UpAxis::y ? 0 : 1;
  openvdb::Mat4d matrix = openvdb::Mat4d::identity();
  matrix[first][first] = matrix[second][second] = c;
  matrix[first][second] = s;
  matrix[second][first] = -s;
  return matrix;
}

openvdb::Mat4d matrix_of(const SkyInstance& instance, UpAxis up) {
  openvdb::Mat4d matrix = openvdb::Mat4d::identity();
  matrix.postScale(openvdb::Vec3d(instance.scale));
  matrix = matrix * turn_matrix(instance.point.turn, up);
  matrix.postTranslate(openvdb::Vec3d(instance.point.x, instance.point.y, instance.point.z));
  return matrix;
}

Box<3> intersect(const Box<3>& a, const Box<3>& b) {
  return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

// All voxels that a cloud may reach.
Topology voxels_of(const SkyPlan& plan, const GridFrame& frame, const std::optional<Box<3>>& region) {
  Topology all{frame, std::make_shared<openvdb::MaskTree>(false)};
  for (const SkyInstance& instance : plan.instances) {
    const Box<3> reached = bounds_of(plan, instance);
    if (region && !overlap(reached, *region)) continue;
    const Box<3> box = region ? intersect(reached, *region) : reached;
    if (!frame.voxels_in(box).empty()) all.mask->topologyUnion(*box_topology(frame, box).mask);
  }
  return all;
}

void note_sky(const SkyPlan& plan, const std::string& creator, const FilledGrid& filled) {
  openvdb::FloatGrid& grid = *filled.grid;
  const VolumeRecipe& cloud = plan.recipe.cloud;
  const OutputGrid output = output_grids(cloud).front();
  name_grid(output, creator, grid);
  note_recipe(cloud, {filled.moments}, grid);
  set_metadata(grid, {{kRecipeKey, format_json(to_json(plan.recipe))}});
}

}  // namespace

Volume make_sky_grid(const SkyPlan& plan, const std::optional<Box<3>>& region, const std::string& creator,
                     Progress* progress) {
  const GridFrame frame(plan.recipe.voxel);
  constexpr double kClouds = 0.6;  // of the work
  std::vector<openvdb::FloatGrid::ConstPtr> clouds;
  for (const SkyCloud& cloud : plan.clouds) {
    const auto share = [&](std::size_t k) {
      return kClouds * static_cast<double>(k) / static_cast<double>(plan.clouds.size());
    };
    PartialProgress of_cloud(progress, share(clouds.size()), share(clouds.size() + 1));
    const Volume volume = make_sky_cloud(cloud, creator, &of_cloud);
    clouds.push_back(openvdb::gridConstPtrCast<openvdb::FloatGrid>(volume.grids.front().grid));
  }
  std::vector<PlacedCloud> placed;
  for (const SkyInstance& instance : plan.instances) {
    placed.push_back(
        {clouds[instance.cloud], matrix_of(instance, plan.recipe.cloud.up), bounds_of(plan, instance)});
  }
  PartialProgress of_sky(progress, kClouds, 1.0);
  const FilledGrid filled =
      fill_grid(voxels_of(plan, frame, region), PlacedClouds(placed), Sparsity::drop, &of_sky);
  note_sky(plan, creator, filled);
  return {{{filled.grid, {filled.moments}}}};
}

Box<3> bounds_of(const SkyPlan& plan, const SkyInstance& instance) {
  const Box<3>& box = plan.recipe.cloud.box;
  const double unit = plan.clouds[instance.cloud].unit * instance.scale;
  const int up = vertical_axis(plan.recipe.cloud);
  const Vec<3> half = 0.5 * unit * (box.upper - box.lower);
  // Whatever the turn; and what shapes and interpolation reach beyond.
  const double beyond = 3.0 * plan.recipe.voxel;
  const double across = std::hypot(half[0], half[3 - up]) + beyond;
  Vec<3> lower(instance.point.x, instance.point.y, instance.point.z);
  Vec<3> upper = lower;
  lower -= across;
  upper += across;
  lower[up] += across - beyond;
  upper[up] += 2.0 * half[up] - across + beyond;
  return {lower, upper};
}

SkyPlan plan_in(const SkyPlan& plan, const Box<3>& region) {
  SkyPlan result{plan.recipe, plan.form, {}, {}};
  std::vector<std::size_t> number(plan.clouds.size(), plan.clouds.size());
  for (const SkyInstance& instance : plan.instances) {
    if (!overlap(bounds_of(plan, instance), region)) continue;
    std::size_t& cloud = number[instance.cloud];
    if (cloud == plan.clouds.size()) {
      cloud = result.clouds.size();
      result.clouds.push_back(plan.clouds[instance.cloud]);
    }
    result.instances.push_back(instance);
    result.instances.back().cloud = cloud;
  }
  return result;
}

double kept_share(const VolumeRecipe& recipe, const VolumePlan& plan) {
  constexpr int kLeaf = 8;
  constexpr int kMostAlong = 64;  // else blocks of leaves, so that few are looked at
  const FieldPtr field = make_volume_field(recipe, plan).field;
  int side = kLeaf;
  while (side * kMostAlong < plan.voxels.dim()[plan.voxels.maxExtent()]) side *= 2;
  const openvdb::Coord first = plan.voxels.min() & -side;
  double all = 0.0;
  double kept = 0.0;
  for (openvdb::Coord block = first; block.x() <= plan.voxels.max().x(); block.x() += side) {
    for (block.y() = first.y(); block.y() <= plan.voxels.max().y(); block.y() += side) {
      for (block.z() = first.z(); block.z() <= plan.voxels.max().z(); block.z() += side) {
        all += 1.0;
        if (!field->empty(plan.frame.bounds(openvdb::CoordBBox::createCube(block, side)))) kept += 1.0;
      }
    }
  }
  return kept / all;
}

namespace {

// Of the leaves that instances may reach, each counted once: their share of the sum of each instance's.
double distinct_share(const SkyPlan& plan) {
  const GridFrame leaves(8.0 * plan.recipe.voxel);
  double sum = 0.0;
  for (const SkyInstance& instance : plan.instances)
    sum += static_cast<double>(leaves.voxels_in(bounds_of(plan, instance)).volume());
  const Topology all = voxels_of(plan, leaves, std::nullopt);
  return static_cast<double>(all.mask->activeVoxelCount()) / sum;
}

}  // namespace

Cost placing_cost(const SkyPlan& plan, const std::vector<double>& kept) {
  constexpr double kSecondsPerVoxel = 100e-9;  // of an instance's bounds; measured with the preset
  constexpr double kTopologyShare = 1.0 / 12;  // of what a leaf takes: its mask, and its place in lists
  constexpr double kWriting = 1.08;            // what compresses the grid
  constexpr double kGaps = 30.0 * 0x1p20;      // that clouds leave in memory which are made one by one
  const auto bytes_of = [](const openvdb::CoordBBox& voxels) {
    return static_cast<double>(estimate_memory(voxels));
  };
  const VolumeRecipe& cloud = plan.recipe.cloud;
  Cost cost{0.0, kGaps};
  for (std::size_t i = 0; i < plan.clouds.size(); ++i)
    cost.bytes += kept[i] * bytes_of(GridFrame(*plan.clouds[i].recipe.voxel).voxels_in(cloud.box));
  const GridFrame frame(plan.recipe.voxel);
  const double distinct = distinct_share(plan);
  for (const SkyInstance& instance : plan.instances) {
    const openvdb::CoordBBox voxels = frame.voxels_in(bounds_of(plan, instance));
    const GridFrame scaled(*plan.clouds[instance.cloud].recipe.voxel / instance.scale);
    cost.bytes += distinct * (kTopologyShare * bytes_of(voxels) +
                              kWriting * kept[instance.cloud] * bytes_of(scaled.voxels_in(cloud.box)));
    cost.seconds += kSecondsPerVoxel * voxels.dim().x() * voxels.dim().y() * voxels.dim().z();
  }
  return cost;
}

}  // namespace solidnoise
