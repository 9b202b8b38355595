// Noises at scattered points: vertices all over a sphere, in no order, kKernel of them in a kernel's radius.
// All included: putting the points in order, making the impulses, culling, summing.
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include <benchmark/benchmark.h>

#include "noise_bench.h"
#include "reference/gabor_reference.h"
#include "reference/surface_gabor_reference.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise::bench {
namespace {

constexpr std::size_t kVertices = 100000;
constexpr double kKernel = 16.0;  // vertices along a kernel's radius
constexpr double kImpulses = 32.0;

// A sphere of radius 1.
struct Sphere {
  std::array<std::vector<float>, 3> position;
  std::vector<Vec<3>> positions;  // the same
  std::vector<float> frequency;   // over two octaves from pole to pole, relative to that of the options
  double spacing = std::sqrt(4.0 * std::numbers::pi / kVertices);

  Sphere() {
    std::mt19937 generator(1);
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < kVertices; ++i) {
      std::array<float, 3> v{normal(generator), normal(generator), normal(generator)};
      const float length = std::hypot(v[0], v[1], v[2]);
      for (std::size_t axis = 0; axis < 3; ++axis) position[axis].push_back(v[axis] / length);
      frequency.push_back(std::exp2(position[2].back()));
      positions.emplace_back(position[0].back(), position[1].back(), position[2].back());
    }
  }
  Points<3> points() const { return {positions}; }
  SurfacePoints surface() const { return {points(), {position[0], position[1], position[2]}}; }
  std::vector<float> frequencies(double constant) const {
    std::vector<float> result = frequency;
    for (float& f : result) f *= static_cast<float>(constant);
    return result;
  }
};

const Sphere& sphere() {
  static const Sphere made;
  return made;
}

template <typename Evaluate>
void register_points(const std::string& name, const Evaluate& evaluate) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    std::vector<float> values(kVertices);
    for (auto _ : state) {
      evaluate(values);
      benchmark::DoNotOptimize(values.data());
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kVertices));
  });
}

// One vertex after the other, by a scalar procedure of position and normal.
template <typename Procedure>
void register_scalar(const std::string& name, const Procedure& procedure) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(procedure(i));
      if (++i == kVertices) i = 0;
    }
    state.SetItemsProcessed(state.iterations());
  });
}

template <typename Real>
std::array<Real, 3> vertex(std::size_t i) {
  const auto& p = sphere().position;
  return {static_cast<Real>(p[0][i]), static_cast<Real>(p[1][i]), static_cast<Real>(p[2][i])};
}

void add_surface(std::vector<Ratio>& ratios) {
  const double radius = kKernel * sphere().spacing;
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    SurfaceGaborOptions options;
    options.frequency = 1.0;
    options.impulses = kImpulses;
    options.waves = waves;
    options.frequency = SurfaceGaborNoise(options).radius() / radius;
    const auto noise = std::make_shared<const SurfaceGaborNoise>(options);
    const bool isotropic = waves == GaborWaves::isotropic;
    const std::string name =
        std::string("points/surface/") + (isotropic ? "isotropic" : "oriented") + "/N32/";
    register_points(name + "stationary", [noise](std::span<float> values) {
      noise->evaluate(sphere().surface(), {}, {values, {}});
    });
    const std::vector<float> frequencies = sphere().frequencies(options.frequency);
    register_points(name + "varying", [noise, frequencies](std::span<float> values) {
      noise->evaluate(sphere().surface(),
                      {.frequency = frequencies, .bandwidth = {}, .magnitude = {}, .direction = {}},
                      {values, {}});
    });
    // As times: at most 2, aim 1.3.
    ratios.push_back({std::string(isotropic ? "surface" : "oriented surface") +
                          " noise, varying over stationary (1/2, 1/1.3)",
                      name + "stationary", name + "varying", 0.5, 0.77});
    if (!isotropic) continue;
    const reference::SurfaceGaborProcedure<float> procedure(
        {options.frequency, gaussian_parameter(options.frequency, 1.0)}, radius, kImpulses, 1u);
    register_scalar(name + "scalar",
                    [procedure](std::size_t i) { return procedure(vertex<float>(i), vertex<float>(i)); });
    ratios.push_back(
        {"vertices, surface noise N32, over scalar", name + "scalar", name + "stationary", 14.0, 20.0});
    ratios.push_back(
        {"vertices, varying surface noise N32, over scalar", name + "scalar", name + "varying", 7.0, 15.0});
  }
}

void add_solid(std::vector<Ratio>& ratios) {
  const double radius = kKernel * sphere().spacing;
  const double frequency = GaborNoise<3>({.frequency = 1.0}).radius() / radius;
  const std::string name = "points/solid/isotropic/N32/";
  const auto noise =
      std::make_shared<const GaborNoise<3>>(GaborNoiseOptions{.frequency = frequency, .impulses = kImpulses});
  register_points(name + "stationary", [noise](std::span<float> values) {
    noise->evaluate(sphere().points(), Samples<3>{values, {}});
  });
  const auto varying = std::make_shared<const VaryingGaborNoise<3>>(
      VaryingGaborOptions{.frequency = frequency, .impulses = kImpulses});
  const std::vector<float> frequencies = sphere().frequencies(frequency);
  register_points(name + "varying", [varying, frequencies](std::span<float> values) {
    varying->evaluate(sphere().points(),
                      {.frequency = frequencies, .bandwidth = {}, .magnitude = {}, .direction = {}},
                      {values, {}});
  });
  register_points(name + "varying-one-grid", [varying](std::span<float> values) {
    varying->evaluate(sphere().points(), {}, {values, {}});
  });
  const reference::GaborProcedure<3, reference::IsotropicKernel, float> procedure(
      {frequency, gaussian_parameter(frequency, 1.0)}, radius, kImpulses, 1u);
  register_scalar(name + "scalar", [procedure](std::size_t i) { return procedure(vertex<float>(i)); });
  ratios.push_back(
      {"vertices, solid noise N32, over scalar", name + "scalar", name + "stationary", 14.0, 20.0});
  ratios.push_back(
      {"vertices, varying solid noise N32, over scalar", name + "scalar", name + "varying", 7.0, 15.0});
  // As times: at most 2, aim 1.3.
  ratios.push_back({"solid noise, varying over stationary (1/2, 1/1.3)", name + "stationary",
                    name + "varying", 0.5, 0.77});
}

void add_projected() {
  constexpr double kCells = 6.0;  // vertices along a lattice cell
  ProjectedGradientOptions options{.frequency = 1.0};
  options.frequency = ProjectedGradientNoise(options).lattice_spacing() / (kCells * sphere().spacing);
  const auto noise = std::make_shared<const ProjectedGradientNoise>(options);
  register_points("points/projected/kensler/best", [noise](std::span<float> values) {
    noise->evaluate(sphere().surface(), {values, {}});
  });
}

}  // namespace

void add_scattered(std::vector<Ratio>& ratios) {
  add_surface(ratios);
  add_solid(ratios);
  add_projected();
}

}  // namespace solidnoise::bench
