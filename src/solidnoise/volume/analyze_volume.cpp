#include "solidnoise/volume/analyze_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/analysis/expected_spectrum.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/core/named_error.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/stored_recipe.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

constexpr int kShortestSide = 8;
constexpr int kLongestBlock = 128;  // of the block that is analysed

bool all_active(const openvdb::FloatGrid& grid, const openvdb::CoordBBox& box) {
  const auto accessor = grid.getConstAccessor();
  for (auto voxel = box.begin(); voxel; ++voxel) {
    if (!accessor.isValueOn(*voxel)) return false;
  }
  return true;
}

// The middle of a box, its sides scaled and then cut to kLongestBlock.
openvdb::CoordBBox middle_of(const openvdb::CoordBBox& box, double scale) {
  openvdb::CoordBBox middle;
  for (int axis = 0; axis < 3; ++axis) {
    const int length = box.dim()[axis];
    const int side = std::min(static_cast<int>(length * scale), kLongestBlock);
    middle.min()[axis] = box.min()[axis] + (length - side) / 2;
    middle.max()[axis] = middle.min()[axis] + side - 1;
  }
  return middle;
}

// The values of a block from the middle of a grid, of which all voxels are active: as large as the grid and
// kLongestBlock allow. None where it would be under 8 voxels wide, too little to measure a spectrum.
std::optional<DenseField<3>> dense_block(const openvdb::FloatGrid& grid) {
  const openvdb::CoordBBox bounds = grid.evalActiveVoxelBoundingBox();
  constexpr double kStep = 0.93;
  for (double scale = 1.0; !bounds.empty(); scale *= kStep) {
    const openvdb::CoordBBox box = middle_of(bounds, scale);
    const openvdb::Coord sides = box.dim();
    if (std::min({sides.x(), sides.y(), sides.z()}) < kShortestSide) break;
    if (!all_active(grid, box)) continue;

    DenseField<3> block({sides.x(), sides.y(), sides.z()}, GridFrame(grid.transform()).voxel_size());
    const auto accessor = grid.getConstAccessor();
    float* value = block.values.data();
    for (auto voxel = box.begin(); voxel; ++voxel) *value++ = accessor.getValue(*voxel);
    return block;
  }
  return std::nullopt;
}

constexpr int kHistogramBins = 80;
constexpr double kHistogramReach = 5.0;  // sigmas on each side of the mean

Json describe_moments(const Moments& moments) {
  Json json = Json::object();
  json["voxels"] = moments.count();
  json["min"] = moments.min();
  json["max"] = moments.max();
  json["mean"] = moments.mean();
  json["variance"] = moments.sigma() * moments.sigma();
  json["skewness"] = moments.skewness();
  json["excess_kurtosis"] = moments.excess_kurtosis();
  return json;
}

double gaussian_probability_below(double sigmas) {
  return 0.5 * std::erfc(-sigmas / std::numbers::sqrt2);
}

// Counts of the values beside those of a Gaussian with the given moments.
Json describe_histogram(const openvdb::FloatGrid& grid, double mean, double sigma) {
  const Histogram measured =
      histogram(grid, mean - kHistogramReach * sigma, mean + kHistogramReach * sigma, kHistogramBins);
  std::uint64_t total = measured.below + measured.above;
  for (const std::uint64_t count : measured.counts) total += count;

  Json json = Json::object();
  json["gaussian_mean"] = mean;
  json["gaussian_sigma"] = sigma;
  json["lower"] = measured.lower;
  json["upper"] = measured.upper;
  json["counts"] = measured.counts;
  double largest_difference = 0.0;
  double cumulated = static_cast<double>(measured.below);
  double lower = gaussian_probability_below(-kHistogramReach);
  for (int bin = 0; bin < kHistogramBins; ++bin) {
    const double edge = kHistogramReach * (2.0 * (bin + 1) / kHistogramBins - 1.0);
    const double upper = gaussian_probability_below(edge);
    json["gaussian_counts"].push_back((upper - lower) * static_cast<double>(total));
    cumulated += static_cast<double>(measured.counts[static_cast<std::size_t>(bin)]);
    largest_difference =
        std::max(largest_difference, std::abs(cumulated / static_cast<double>(total) - upper));
    lower = upper;
  }
  json["largest_difference_of_distributions"] = largest_difference;
  return json;
}

// Impulses per unit of volume, as far as they make the power of the noise scatter; 0 where it is Gaussian
// enough.
double effective_impulse_density(const VolumeRecipe& recipe) {
  if (recipe.dims != 3) return 0.0;
  if (const auto* gabor = std::get_if<GaborNoiseOptions>(&recipe.noise.noise)) {
    const WeightMoments weights = weight_moments(gabor->weights);
    return GaborNoise<3>(*gabor).impulse_density() * weights.second * weights.second / weights.fourth;
  }
  if (const auto* oriented = std::get_if<OrientedGaborNoiseOptions>(&recipe.noise.noise)) {
    return OrientedGaborNoise<3>(*oriented).impulse_density();
  }
  if (const auto* spectrum = std::get_if<SpectrumNoiseOptions>(&recipe.noise.noise)) {
    return SpectrumNoise<3>(*spectrum).least_impulse_density();
  }
  return 0.0;
}

// The expected periodogram of a spectrum without symmetry would take minutes; that of a noise whose waves are
// far shorter than a voxel, or longer than the block, as long as the file likes, and say nothing.
bool is_comparable(const AnalysisSubject& subject) {
  constexpr double kMostCyclesPerVoxel = 3.0;  // of the images that are summed
  if (!subject.noise || !subject.block) return false;
  const Vec<3>& step = subject.block->step;
  const Vec<3> size = step * Vec<3>(subject.block->count);
  const double highest = subject.noise->band().upper;
  if (highest * std::max({step.x, step.y, step.z}) > kMostCyclesPerVoxel) return false;
  if (highest * std::max({size.x, size.y, size.z}) < 1.0) return false;
  const auto* const spectrum = std::get_if<SpectrumNoiseOptions>(&subject.recipe->noise.noise);
  return !spectrum || spectrum->model.channels.front().isotropic;
}

const OrientedGaborNoiseOptions* oriented_options(const VolumeRecipe& recipe) {
  return std::get_if<OrientedGaborNoiseOptions>(&recipe.noise.noise);
}

PowerSpectrum<3> expected_spectrum(const AnalysisSubject& subject, const PowerSpectrum<3>& measured) {
  const auto* const oriented = oriented_options(*subject.recipe);
  const std::optional<Vec<3>> axis = oriented ? std::optional(Vec<3>(oriented->direction)) : std::nullopt;
  return expected_periodogram(*subject.noise, measured.count, measured.step, measured.window, axis);
}

SpectrumComparison compare(const AnalysisSubject& subject, const PowerSpectrum<3>& measured) {
  ComparisonOptions options;
  options.impulse_density = effective_impulse_density(*subject.recipe);
  if (const auto* const oriented = oriented_options(*subject.recipe)) options.kernel_error = oriented->error;
  if (const auto* const spectrum = std::get_if<SpectrumNoiseOptions>(&subject.recipe->noise.noise)) {
    options.kernel_error = spectrum->error;
  }
  return compare_spectra(measured, expected_spectrum(subject, measured), options);
}

Json describe_bin(const RadialBin& bin) {
  Json json = Json::object();
  json["frequency"] = bin.frequency;
  json["power"] = bin.power;
  json["standard_error"] = bin.standard_error;
  return json;
}

// Frequencies in cycles per world unit; powers are two-sided densities, value^2 per (cycle per unit)^3.
Json describe_spectrum(const AnalysisReport& report, const DenseField<3>& block) {
  Json json = Json::object();
  json["block"] = {block.count.x, block.count.y, block.count.z};
  json["bins"] = Json::array();
  if (!report.comparison) {
    for (const RadialBin& bin : report.spectrum) json["bins"].push_back(describe_bin(bin));
    return json;
  }
  json["chi_square"] = report.comparison->chi_square;
  json["degrees_of_freedom"] = report.comparison->degrees_of_freedom;
  json["significance"] = report.comparison->significance;
  for (const ComparedBin& bin : report.comparison->bins) {
    json["bins"].push_back(describe_bin(bin.measured));
    json["bins"].back()["expected"] = bin.expected;
  }
  return json;
}

Json describe_expected(const Noise<3>* noise) {
  if (!noise) return nullptr;
  Json json = Json::object();
  json["mean"] = 0.0;
  json["variance"] = noise->variance();
  json["excess_kurtosis"] = noise->excess_kurtosis();
  return json;
}

// Whether the recipe's grid of this name is its noise.
bool holds_noise_itself(const VolumeRecipe& recipe, const std::string& name) {
  const std::vector<OutputGrid> grids = output_grids(recipe);
  const auto is_value = [&](const OutputGrid& grid) {
    return grid.output == Output::value && (grid.name == name || grids.size() == 1);
  };
  const auto* raw = std::get_if<RawShaping>(&recipe.shaping);
  return raw && std::ranges::any_of(grids, is_value) && !recipe.modification &&
         raw->range == RawShaping::Range::raw && recipe.layers.empty() && !recipe.within &&
         !recipe.parameters.any();
}

}  // namespace

// Measured on grids of 64^3 to 384^3 voxels, all of them active: the transform of the block, with its closed
// form, takes most. Of sparse grids, whose block is smaller or none, it takes less.
Cost analysis_cost(const GridSummary& grid) {
  constexpr double kProgramBytes = 50.0 * 0x1p20;
  constexpr double kBytesPerBlockVoxel = 125.0;
  constexpr double kSecondsPerBlockVoxel = 1.2e-6;
  constexpr double kSecondsPerVoxel = 40e-9;
  const auto voxels = static_cast<double>(grid.active_voxels);
  double block = 1.0;
  for (int axis = 0; axis < 3; ++axis) block *= std::min(grid.voxel_bounds.dim()[axis], kLongestBlock);
  block = std::min(block, voxels);
  return {0.6 + kSecondsPerBlockVoxel * block + kSecondsPerVoxel * voxels,
          kProgramBytes + memory_of(grid) + kBytesPerBlockVoxel * block};
}

AnalysisSubject analysis_subject(openvdb::FloatGrid::Ptr grid, const std::string& file) {
  AnalysisSubject subject;
  subject.grid = std::move(grid);
  as_file_error([&] {
    require_finite_values(*subject.grid, fmt::format("{}: grid '{}'", file, subject.grid->getName()));
  });
  subject.recipe = stored_recipe(*subject.grid, file);
  if (subject.recipe) subject.recipe = recipe_of_grid(*subject.recipe, subject.grid->getName());
  const openvdb::Vec3d voxel = subject.grid->voxelSize();
  if (subject.recipe) *subject.recipe = at_resolution(*subject.recipe, {voxel.x(), voxel.y(), voxel.z()});
  if (subject.recipe && holds_noise_itself(*subject.recipe, subject.grid->getName())) {
    subject.noise = make_volume_noise(*subject.recipe);
  }
  subject.block = dense_block(*subject.grid);
  return subject;
}

AnalysisReport analyze(const AnalysisSubject& subject, Progress* progress) {
  constexpr std::uint64_t kSteps = 3;
  std::uint64_t done = 0;
  const auto end_step = [&] {
    throw_if_cancelled(progress);
    if (progress) progress->advance(++done, kSteps);
  };
  const Moments moments = measure(*subject.grid);
  end_step();
  const double mean = subject.noise ? 0.0 : moments.mean();
  const double sigma = subject.noise ? std::sqrt(subject.noise->variance()) : moments.sigma();
  AnalysisReport report;
  report.json["grid"] = subject.grid->getName();
  report.json["moments"] = describe_moments(moments);
  report.json["expected"] = describe_expected(subject.noise.get());
  report.json["histogram"] = sigma > 0.0 ? describe_histogram(*subject.grid, mean, sigma) : Json(nullptr);
  report.json["spectrum"] = nullptr;
  end_step();
  if (!subject.block) return report;

  PeriodogramOptions options;
  options.mean = mean;
  const PowerSpectrum<3> spectrum = periodogram(*subject.block, options);
  report.spectrum = radial_average(spectrum);
  end_step();
  if (is_comparable(subject)) report.comparison = compare(subject, spectrum);
  report.json["spectrum"] = describe_spectrum(report, *subject.block);
  return report;
}

}  // namespace solidnoise
