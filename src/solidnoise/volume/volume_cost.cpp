#include "solidnoise/volume/volume_cost.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include <tbb/global_control.h>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/coarse_samples.h"
#include "solidnoise/noise/interpolation/point_plan.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/modified_volume.h"
#include "solidnoise/volume/stream_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

// Measured with each preset: storing a voxel, shaping its noise, and piling a cloud.
constexpr double kSecondsPerVoxel = 15e-9;
constexpr double kSecondsPerShapedVoxel = 30e-9;
constexpr double kSecondsPerCloudVoxel = 150e-9;
constexpr double kSecondsPerDisplacedVoxel = 4e-6;

// Voxels from which on blocks are of 64^3, else of 32^3 (fill_grids()).
constexpr double kManyVoxels = 64.0 * 512.0 * 512.0;

// What reads and writes pictures, and a picture; measured with each look.
constexpr double kPictureBytes = 104.0 * 0x1p20;

// A program with OpenVDB loaded and its tables of kernels; and, relative to the grids, what compresses them.
constexpr double kProgramBytes = 57.0 * 0x1p20;
constexpr double kProgramSeconds = 0.05;  // and a volume's plan
constexpr double kWriting = 1.08;

constexpr double kLeafSide = 8.0;

bool at_points(const VolumeRecipe& recipe, const VolumePlan& plan) {
  return recipe.parameters.vary_kernel() || (plan.modification && !plan.modification->on_lattice());
}

double seconds_per_voxel(const VolumeRecipe& recipe) {
  if (std::holds_alternative<RawShaping>(recipe.shaping)) return kSecondsPerVoxel;
  return kSecondsPerVoxel + (std::holds_alternative<CloudShaping>(recipe.shaping) ? kSecondsPerCloudVoxel
                                                                                  : kSecondsPerShapedVoxel);
}

// What a noise takes to be normalized.
double normalization_seconds(const VolumeRecipe& recipe, const Noise<3>& noise) {
  const auto* const raw = std::get_if<RawShaping>(&recipe.shaping);
  return raw && raw->normalize ? cost_at_points(noise, PointWork{kMostNormalizationSamples}).seconds : 0.0;
}

bool contains(const VolumeRecipe& recipe, Output output) {
  return std::ranges::find(recipe.output, output) != recipe.output.end();
}

// How many noises like its own a short form's outputs are made of.
int channel_count(const VolumeRecipe& recipe) {
  if (contains(recipe, Output::curl) || contains(recipe, Output::color)) return 3;
  return contains(recipe, Output::phase) || contains(recipe, Output::intensity) ? 2 : 1;
}

double count(const openvdb::CoordBBox& voxels) {
  return voxels.empty() ? 0.0 : static_cast<double>(voxels.dim().x()) * voxels.dim().y() * voxels.dim().z();
}

// Of the plan's part.
double voxels_of(const VolumePlan& plan) {
  double voxels = plan.modification ? static_cast<double>(plan.modification->grid().activeVoxelCount())
                  : plan.grid       ? static_cast<double>(plan.grid->activeVoxelCount())
                                    : count(plan.voxels);
  if (plan.part.region) {
    openvdb::CoordBBox region = plan.frame.voxels_in(*plan.part.region);
    region.intersect(plan.voxels);
    voxels *= count(region) / count(plan.voxels);
  }
  return voxels / plan.part.shards;
}

// The side of blocks, of which few voxels need only one.
double block_side(const VolumePlan& plan) {
  const openvdb::Coord size = plan.voxels.dim();
  const double longest = std::max({size.x(), size.y(), size.z(), static_cast<int>(kLeafSide)});
  return std::min(voxels_of(plan) < kManyVoxels ? 32.0 : 64.0, longest);
}

// Of samples that others are interpolated from: CoarseStore keeps those of one part of the noise for all
// threads, in tiles, with the impulses of tiles that are not whole, as those at the volume's surface stay.
// Each thread holds the samples around its block, in bricks.
struct SampleSpacing {
  Vec<3> step{1.0};  // voxels
  glm::ivec3 taps{1};
  double beyond = 0.0;  // a block, to either side, voxels: where warps move them to
};
double interpolation_bytes(const SampleSpacing& samples, const WaveMixture<3>& waves,
                           const LatticeFrame<3>& lattice, const VolumePlan& volume, int threads) {
  constexpr double kTile = CoarseStore<3>::kBrickSide * CoarseStore<3>::kTileBricks;
  constexpr double kUnfinished = 0.5;
  double tiles = 1.0;
  double inner_tiles = 1.0;
  double held = sizeof(float);
  for (int axis = 0; axis < 3; ++axis) {
    const double step = samples.step[axis];
    const double along = std::ceil((volume.voxels.dim()[axis] + 2.0 * samples.beyond) / (kTile * step) + 1.0);
    tiles *= along;
    inner_tiles *= std::max(along - 2.0, 0.0);
    held *= (block_side(volume) + 2.0 * samples.beyond) / step + samples.taps[axis] +
            2 * CoarseStore<3>::kBrickSide;
  }
  const ImpulsesHeld impulses = impulses_held(waves, samples.step * lattice.step, kTile);
  const double holders =
      impulses.side < kTile ? threads : kUnfinished * (tiles - inner_tiles) / volume.part.shards;
  const double kept = tiles * std::pow(kTile, 3) * sizeof(float) / volume.part.shards;
  return std::min(kept, static_cast<double>(CoarseStore<3>::kMostBytes)) + held * threads +
         holders * impulses.bytes;
}

// Of a noise whose kernel varies, at points. Each octave of frequencies is a noise of its own there, of which
// a point has two, and blocks make the impulses of all. Measured with maps over 0 to 4 octaves.
double varying_seconds(const VolumeRecipe& recipe, const VolumePlan& plan, const Noise<3>& noise) {
  constexpr double kAtPoint = 2.8;  // times what a noise of one frequency takes
  constexpr double kSecondsPerImpulse = 1e-6;
  const double own = std::visit([](const auto& options) { return options.frequency; }, recipe.noise.noise);
  double highest = own;
  double octaves = 0.0;
  if (const auto& frequency = recipe.parameters.frequency; frequency && frequency->map) {
    const auto& map = *frequency->map;
    highest = std::max(map.at_low, map.at_high);
    octaves = std::abs(std::log2(map.at_high / map.at_low));
  }
  double made = 0.0;
  const auto add = [&](const Noise<3>& part) {
    const WaveMixture<3> waves = part.waves();
    made += waves.impulses / (4.0 / 3.0 * std::numbers::pi * std::pow(waves.radius, 3));
  };
  const auto parts = noise.parts();
  if (parts.empty()) add(noise);
  for (const auto& part : parts) add(*part.noise);
  made *= std::pow(highest / own, 3);
  for (int axis = 0; axis < 3; ++axis) made *= plan.box.upper[axis] - plan.box.lower[axis];
  const double points = voxels_of(plan);
  return kAtPoint * (1.0 + octaves) * cost_at_points(noise, PointWork{points}).seconds +
         kSecondsPerImpulse * made / plan.part.shards;
}

Cost noise_cost(const VolumeRecipe& recipe, const NoiseRecipe& of, const VolumePlan& plan, int threads) {
  VolumeRecipe single = recipe;
  single.noise = noise_of_output(recipe, of);
  const auto noise = make_volume_noise(single);
  const double voxels = voxels_of(plan);
  const double error = recipe.exact ? 0.0 : ErrorBudget(error_of(of)).interpolation;
  const LatticeFrame<3> lattice = voxel_lattice(single, plan.frame);
  const auto parts = noise->parts();
  const auto waves_of = [&](std::size_t i) {
    return parts.empty() ? noise->waves() : parts[i].noise->waves();
  };
  const double voxel = std::min({lattice.step.x, lattice.step.y, lattice.step.z});
  if (const double warp = largest_warp(recipe.layers, recipe.fields); warp > 0.0) {
    const PointSpread spread = spread_by_warp(plan, warp);
    const auto plans = plan_points(*noise, lattice, error, spread);
    Cost cost = cost_at_points(*noise, voxels, plans);
    cost.bytes *= threads;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      if (plans[i].direct()) continue;
      cost.bytes +=
          interpolation_bytes({Vec<3>(plans[i].spacing), glm::ivec3(plans[i].taps), spread.reach.x / voxel},
                              waves_of(i), lattice, plan, threads);
    }
    return cost;
  }
  if (at_points(recipe, plan)) {
    const Cost cost = cost_at_points(*noise, PointWork{voxels, voxel});
    const bool varies = recipe.parameters.vary_kernel();
    return {varies ? varying_seconds(recipe, plan, *noise) : cost.seconds, cost.bytes * threads};
  }
  const Quantity quantity = has_gradient(recipe) ? Quantity::gradient : Quantity::values;
  const auto plans = InterpolationPlanner<3>(*noise, lattice).plan(error, quantity);
  Cost cost = cost_on_lattice(*noise, lattice, {.samples = voxels, .side = block_side(plan)}, plans);
  cost.seconds += normalization_seconds(recipe, *noise);
  cost.bytes *= threads;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (plans[i].direct()) continue;
    SampleSpacing samples;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [step, taps] = plans[i].axes[static_cast<std::size_t>(axis)];
      samples.step[axis] = step;
      samples.taps[axis] = taps;
    }
    cost.bytes += interpolation_bytes(samples, waves_of(i), lattice, plan, threads);
  }
  return cost;
}

// Masks: the shape's, that of each grid which leaves out voxels of 0, and those of a slab with its values;
// or, of a small volume, what all of it takes.
double streamed_bytes(const VolumeRecipe& recipe, const VolumePlan& plan) {
  constexpr double kSlab = 1.25 * kSlabBytes;
  const auto grids = output_grids(recipe);
  const auto sparse =
      std::ranges::count_if(grids, [](const OutputGrid& grid) { return !keeps_all_voxels(grid.single); });
  return static_cast<double>(plan.mask_memory) * static_cast<double>(1 + sparse) +
         std::min(kSlab, kWriting * static_cast<double>(plan.memory));
}

Cost evaluation_cost(const VolumeRecipe& recipe, const VolumePlan& plan, int threads) {
  Cost cost;
  if (plan.modification && plan.modification->modification.displace) {
    cost.seconds += kSecondsPerDisplacedVoxel * estimate_voxels(recipe, *plan.modification);
  }
  for (const VolumePlan::GridBoundary& boundary : plan.boundaries) {
    if (boundary.distance) cost.seconds += boundary.distance->seconds();
  }
  for (const VolumeRecipe& grid : recipes_of_grids(recipe)) {
    const VolumeRecipe resolved = at_resolution(grid, plan.frame.voxel_size());
    cost.seconds += voxels_of(plan) * channel_count(grid) * seconds_per_voxel(grid);
    std::vector<std::pair<NoiseRecipe, Cost>> known;  // of noises that differ by their seeds alone
    for (const NoiseRecipe& each : noises_of(resolved)) {
      NoiseRecipe noise = each;
      std::visit([](auto& options) { options.seed = 0; }, noise.noise);
      auto found = std::ranges::find(known, noise, &std::pair<NoiseRecipe, Cost>::first);
      if (found == known.end()) {
        known.emplace_back(noise, noise_cost(resolved, noise, plan, threads));
        found = std::prev(known.end());
      }
      for (int channel = 0; channel < channel_count(grid); ++channel) cost += found->second;
    }
  }
  return cost;
}

// With what evaluation takes.
Cost making_cost(const VolumeRecipe& recipe, const VolumePlan& plan, const Cost& evaluation, Making making) {
  if (making == Making::streamed) {
    return {kProgramSeconds + passes_of_stream(recipe) * evaluation.seconds,
            kProgramBytes + streamed_bytes(recipe, plan) + evaluation.bytes};
  }
  return {kProgramSeconds + evaluation.seconds,
          kProgramBytes + kWriting * static_cast<double>(plan.memory) + evaluation.bytes};
}

// Of so many voxels of all grids together, with the bytes of the largest part, in a box.
Cost merge_cost(double voxels, double part, const openvdb::CoordBBox& box) {
  constexpr double kSecondsPerMergedVoxel =
      10e-9;                                     // each is read twice, and looked at once, where it is scaled
  constexpr double kLeastBytes = 48.0 * 0x1p20;  // a slab, and what is being compressed
  const openvdb::Coord size = box.empty() ? openvdb::Coord(0) : box.dim();
  const double columns = sizeof(double) * static_cast<double>(size.x()) * std::max(size.y(), size.z());
  return {voxels * kSecondsPerMergedVoxel, kProgramBytes + std::max(kWriting * part, kLeastBytes) + columns};
}

}  // namespace

int max_threads() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

Cost volume_cost(const VolumeRecipe& recipe, const VolumePlan& plan, int threads, Making making) {
  return making_cost(recipe, plan, evaluation_cost(recipe, plan, threads), making);
}

double seconds_at_points(const VolumeRecipe& recipe, const PointWork& work) {
  double seconds = work.points * seconds_per_voxel(recipe);
  for (const NoiseRecipe& of : noises_of(recipe)) {
    VolumeRecipe single = recipe;
    single.noise = noise_of_output(recipe, of);
    const auto noise = make_volume_noise(single);
    seconds += cost_at_points(*noise, work).seconds + normalization_seconds(recipe, *noise);
  }
  return channel_count(recipe) * seconds;
}

Cost merge_cost(const VolumeRecipe& recipe, const VolumePlan& whole, int parts) {
  const auto grids = static_cast<double>(output_grids(recipe).size());
  const std::uint64_t shape = whole.grid ? whole.grid->memUsage() : 0;  // of which merging needs nothing
  return merge_cost(grids * voxels_of(whole), static_cast<double>(whole.memory - shape) / parts,
                    whole.voxels);
}

Cost merge_cost(const std::vector<std::filesystem::path>& parts, Making making, Target target) {
  double voxels = 0.0;
  double all = 0.0;
  double largest = 0.0;
  openvdb::CoordBBox box;
  for (const std::filesystem::path& part : parts) {
    double bytes = 0.0;
    for (const GridSummary& grid : read_vdb_summary(part).grids) {
      voxels += static_cast<double>(grid.active_voxels);
      bytes += memory_of(grid);
      box.expand(grid.voxel_bounds);
    }
    all += bytes;
    largest = std::max(largest, bytes);
  }
  Cost cost = merge_cost(voxels, largest, box);
  if (making == Making::in_memory) cost.bytes += kWriting * all;
  if (target == Target::picture) cost.bytes += kPictureBytes;
  return cost;
}

MakingPlan plan_making(const VolumeRecipe& recipe, const VolumePlan& plan, int threads, double memory,
                       Target target) {
  const Cost evaluation = evaluation_cost(recipe, plan, threads);
  MakingPlan whole{Making::in_memory, making_cost(recipe, plan, evaluation, Making::in_memory)};
  if (target == Target::picture) whole.cost.bytes += kPictureBytes;
  if (memory == 0.0 || whole.cost.bytes <= memory || target != Target::file || !may_stream(plan))
    return whole;
  const MakingPlan streamed{Making::streamed, making_cost(recipe, plan, evaluation, Making::streamed)};
  return streamed.cost.bytes < whole.cost.bytes ? streamed : whole;
}

}  // namespace solidnoise
