#include <cmath>
#include <utility>
#include <vector>

#include "blocks.h"
#include "quality_cases.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"

namespace solidnoise::bench {
namespace {

constexpr double kError = 0.02;

GaborNoiseOptions lowest_octave(const BudgetCase& budget) {
  GaborNoiseOptions options =
      make_gabor<GaborNoise, 3, GaborNoiseOptions>(budget.radius, budget.impulses)->options();
  options.frequency /= std::pow(2.0, budget.octaves - 1);
  return options;
}

std::shared_ptr<const Noise<3>> sum_of_octaves(const GaborNoiseOptions& lowest, int octaves) {
  std::vector<FractalNoise<3>::Octave> sum;
  for (int k = 0; k < octaves; ++k) {
    GaborNoiseOptions octave = lowest;
    octave.frequency *= std::pow(2.0, k);
    sum.push_back({std::make_shared<GaborNoise<3>>(octave), std::pow(0.5, k)});
  }
  return std::make_shared<FractalNoise<3>>(std::move(sum));
}

}  // namespace

std::string BudgetCase::name() const {
  std::string name = "gabor/3/isotropic/N";
  name.append(std::to_string(impulses)).append("/R").append(std::to_string(radius));
  if (octaves > 1) name.append("x").append(std::to_string(octaves));
  return name;
}

std::shared_ptr<const Noise<3>> BudgetCase::direct() const {
  return sum_of_octaves(lowest_octave(*this), octaves);
}

std::shared_ptr<const Noise<3>> BudgetCase::interpolated() const {
  const GaborNoiseOptions options = with_truncation_share(lowest_octave(*this));
  return interpolate<3>(sum_of_octaves(options, octaves), {}, ErrorBudget(kError).interpolation);
}

}  // namespace solidnoise::bench
