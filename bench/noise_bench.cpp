// How fast the noises are, beside the papers' scalar procedures in the same run.
//
// One sample is one voxel of a block of 32^3 voxels that is evaluated leaf by leaf (8^3), everything
// included: making the block's impulses, culling them, summing. The noises are those of the goals: a kernel
// of R voxels' radius, N impulses in the ball of that radius. The scalar procedures (tests/reference) work
// point by point, in single precision where they can. Names: noise/dimension/kernel/N/R/target.
#include "noise_bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include "block_bench.h"
#include "ratio_reporter.h"
#include "reference/cellular_reference.h"
#include "reference/gabor_reference.h"
#include "reference/kensler_reference.h"
#include "solidnoise/noise/cellular/cellular_noise.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise::bench {
namespace {

// Point by point through one leaf; `Real` is the procedure's number type, `scale` its units per voxel.
template <int Dim, typename Real, typename Procedure>
void evaluate_points(benchmark::State& state, const Procedure& procedure, Real scale) {
  std::int64_t iteration = 0;
  for (auto _ : state) {
    const Index<Dim> corner = block_corner<Dim>(iteration++, 0);
    for (int point = 0; point < kLeaf * kLeaf * kLeaf; ++point) {
      std::array<Real, Dim> position{};
      for (int axis = 0, rest = point; axis < 3; ++axis, rest /= kLeaf) {
        position[axis] = static_cast<Real>(corner[axis] + rest % kLeaf) * scale;
      }
      benchmark::DoNotOptimize(procedure(position));
    }
  }
  state.SetItemsProcessed(state.iterations() * kLeaf * kLeaf * kLeaf);
}

// Registers a benchmark of the widest instruction set ("best") or of AVX2 at the most ("avx2").
template <int Dim>
void register_noise(const std::string& name, std::shared_ptr<const Noise<Dim>> noise,
                    std::int64_t targets = 0) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    hwy::SetSupportedTargetsForTest(targets);
    evaluate_blocks<Dim>(state, *noise);
    hwy::SetSupportedTargetsForTest(0);
  });
}

// The targets that this processor has without AVX-512; 0 if AVX2 is not among them.
std::int64_t targets_up_to_avx2() {
  const std::int64_t targets = hwy::SupportedTargets() & ~(HWY_AVX2 - 1);  // the lower the bit, the better
  return targets & HWY_AVX2 ? targets : 0;
}

template <int Dim, template <int, typename> class Kernel>
void register_reference(const std::string& name, double frequency, double radius, double impulses) {
  using Procedure = reference::GaborProcedure<Dim, Kernel, float>;
  const double a = gaussian_parameter(frequency, 1.0);
  const auto procedure =
      std::make_shared<Procedure>(reference::KernelParameters{frequency, a}, radius, impulses, 1u);
  benchmark::RegisterBenchmark(
      name.c_str(), [=](benchmark::State& state) { evaluate_points<Dim, float>(state, *procedure, 1.0f); });
}

void add_isotropic(std::vector<Ratio>& ratios) {
  const std::int64_t avx2 = targets_up_to_avx2();
  for (const int radius : {16, 6}) {
    const auto noise = make_gabor<GaborNoise, 3, GaborNoiseOptions>(radius, 32);
    const std::string name = "gabor/3/isotropic/N32/R" + std::to_string(radius) + "/";
    register_reference<3, reference::IsotropicKernel>(name + "scalar", noise->options().frequency, radius,
                                                      32);
    register_noise<3>(name + "best", noise);
    const bool large = radius == 16;
    ratios.push_back({"isotropic 3D, R" + std::to_string(radius) + " N32, over scalar", name + "scalar",
                      name + "best", large ? 140.0 : 75.0, large ? 190.0 : 100.0});
    if (large && avx2 != 0) {
      register_noise<3>(name + "avx2", noise, avx2);
      ratios.push_back({"the same, AVX2 only", name + "scalar", name + "avx2", 95.0, 110.0});
    }
  }
}

void add_oriented(std::vector<Ratio>& ratios) {
  const auto noise = make_gabor<OrientedGaborNoise, 3, OrientedGaborNoiseOptions>(16, 32);
  const std::string name = "gabor-oriented/3/random/N32/R16/";
  register_reference<3, reference::OrientedKernel>(name + "scalar", noise->options().frequency, 16, 32);
  register_noise<3>(name + "best", noise);
  ratios.push_back(
      {"random direction and phase 3D, R16 N32, over scalar", name + "scalar", name + "best", 290.0, 370.0});
}

void add_animated(std::vector<Ratio>& ratios) {
  const auto noise = make_gabor<GaborNoise, 4, GaborNoiseOptions>(16, 32);
  const std::string name = "gabor/4/isotropic/N32/R16/";
  register_reference<4, reference::IsotropicKernel>(name + "scalar", noise->options().frequency, 16, 32);
  register_noise<4>(name + "best", noise);
  ratios.push_back(
      {"isotropic 4D, one frame, R16 N32, over scalar", name + "scalar", name + "best", 140.0, 200.0});
}

void add_kensler(std::vector<Ratio>& ratios) {
  constexpr double kVoxelsPerCell = 12.0;
  const double frequency = GradientNoise<3>({.frequency = 1.0}).lattice_spacing()[0] / kVoxelsPerCell;
  const std::string name = "kensler/3/kensler/N-/R24/";
  const reference::KenslerProcedure<3> procedure({});
  benchmark::RegisterBenchmark((name + "scalar").c_str(), [=](benchmark::State& state) {
    evaluate_points<3, double>(state, procedure, 1.0 / kVoxelsPerCell);
  });
  register_noise<3>(name + "best",
                    std::make_shared<GradientNoise<3>>(GradientNoiseOptions{.frequency = frequency}));
  ratios.push_back(
      {"Kensler 3D, 12 voxels per cell, over scalar", name + "scalar", name + "best", 12.0, 15.0});
}

void add_cellular(std::vector<Ratio>& ratios) {
  const auto noise = std::make_shared<CellularNoise<3>>(CellularNoiseOptions{.frequency = 1.0 / 12.0});
  const std::string name = "cellular/3/distance/N30/R23/";
  const reference::CellularProcedure<3> procedure(*noise);
  benchmark::RegisterBenchmark((name + "scalar").c_str(), [=](benchmark::State& state) {
    evaluate_points<3, double>(state, procedure, 1.0);
  });
  register_noise<3>(name + "best", noise);
  ratios.push_back(
      {"cellular 3D, 12 voxels per cell, over scalar", name + "scalar", name + "best", 1500.0, 2000.0});
}

// Wall-clock time per voxel of one thread, and of two that evaluate different blocks.
void add_threads(std::vector<Ratio>& ratios) {
  const auto noise = make_gabor<GaborNoise, 3, GaborNoiseOptions>(16, 32);
  const std::string name = "gabor/3/isotropic/N32/R16/best-threads";
  for (const int threads : {1, 2}) {
    benchmark::RegisterBenchmark((name + std::to_string(threads)).c_str(),
                                 [=](benchmark::State& state) { evaluate_blocks<3>(state, *noise); })
        ->Threads(threads)
        ->UseRealTime();
  }
  ratios.push_back({"two threads over one", name + "1", name + "2", 1.9, 1.95});
}

}  // namespace
}  // namespace solidnoise::bench

int main(int argc, char** argv) {
  std::vector<solidnoise::bench::Ratio> ratios;
  solidnoise::bench::add_isotropic(ratios);
  solidnoise::bench::add_budgets(ratios);
  solidnoise::bench::add_equal_quality(ratios);
  solidnoise::bench::add_oriented(ratios);
  solidnoise::bench::add_animated(ratios);
  solidnoise::bench::add_kensler(ratios);
  solidnoise::bench::add_cellular(ratios);
  solidnoise::bench::add_scattered(ratios);
  solidnoise::bench::add_threads(ratios);

  // --ratios=FILE is ours.
  std::string file;
  constexpr std::string_view kRatios = "--ratios=";
  argc = static_cast<int>(std::remove_if(argv + 1, argv + argc,
                                         [&](std::string_view argument) {
                                           if (!argument.starts_with(kRatios)) return false;
                                           file = argument.substr(kRatios.size());
                                           return true;
                                         }) -
                          argv);

  // Ours come first, so that the command line overrides them.
  std::vector<std::string> settings = {"--benchmark_repetitions=7", "--benchmark_min_time=0.2",
                                       "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> arguments = {argv[0]};
  for (std::string& setting : settings) arguments.push_back(setting.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  solidnoise::bench::RatioReporter reporter(std::move(ratios), file);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
