#include "solidnoise/noise/kernel/impulse_strata.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solidnoise/core/numerics.h"

namespace solidnoise {

namespace {

// Where squared Gaussians exp(-2 pi a^2 r^2), and their transforms, are below 1e-6: times 1 / a, and a.
constexpr double kReach = 1.6;
constexpr double kBand = 3.2;

template <int Dim>
RadialAverages radial_averages(const IsotropicGaborKernel<Dim>& kernel) {
  return RadialAverages::of(
      Dim, [&](double r) { return squared(kernel.value(r)); }, kReach / kernel.a(),
      2.0 * kernel.frequency() + kBand * kernel.a());
}
// The mean over phases.
template <int Dim>
RadialAverages radial_averages(const RandomPhaseGaborKernel<Dim>& kernel) {
  return RadialAverages::of(
      Dim,
      [&](double r) {
        return 0.5 * squared(kernel.amplitude()) *
               std::exp(-2.0 * std::numbers::pi * squared(kernel.a() * r));
      },
      kReach / kernel.a(), kBand * kernel.a());
}
template <int Dim>
RadialAverages radial_averages(const EvenGaborKernel<Dim>& kernel) {
  return RadialAverages(Dim, kReach / kernel.a(), 2.0 * kernel.frequency() + kBand * kernel.a(),
                        [&](double f) { return std::sqrt(kernel.squared_power(f)); });
}

template <typename Kernel>
StrataChoice radial_choice(int dimensions, const Kernel& kernel, const WeightMoments& weights) {
  return {dimensions,
          {kernel.energy(), kernel.fourth_moment()},
          weights,
          std::make_shared<RadialAverages>(radial_averages(kernel)),
          kernel.radius_for_error(kNominalError)};
}

}  // namespace

template <int Dim>
StrataChoice strata_choice(const IsotropicGaborKernel<Dim>& kernel, const WeightMoments& weights) {
  return radial_choice(Dim, kernel, weights);
}

template <int Dim>
StrataChoice strata_choice(const EvenGaborKernel<Dim>& kernel) {
  return radial_choice(Dim, kernel, {});
}

template <int Dim>
StrataChoice strata_choice(const RandomPhaseGaborKernel<Dim>& kernel) {
  const double factor = 0.5 * std::pow(kernel.amplitude(), 2);
  auto averages = std::make_shared<ProductAverages>(
      Dim, [a = kernel.a()](double d) { return std::exp(-2.0 * std::numbers::pi * a * a * d * d); },
      kReach / kernel.a(), factor);
  return {
      Dim, {kernel.energy(), kernel.fourth_moment()}, {}, averages, kernel.radius_for_error(kNominalError)};
}

template <typename Kernel>
StrataChoice layer_strata_choice(const Kernel& in_plane, double half_thickness,
                                 const std::function<double(double)>& window) {
  const auto square = [&](double z) { return squared(window(z / half_thickness)); };
  const auto moment = [&](double power) {
    return 2.0 * integrate([&](double z) { return std::pow(window(z / half_thickness), power); }, 0.0,
                           half_thickness, 4);
  };
  auto averages = std::make_shared<LayerAverages>(radial_averages(in_plane), square, half_thickness);
  return {3,
          {in_plane.energy() * moment(2.0), in_plane.fourth_moment() * moment(4.0)},
          {},
          averages,
          in_plane.radius_for_error(kNominalError)};
}

double kurtosis_given_place(double density, const KernelMoments& kernel, const CubeAverages& averages,
                            double side) {
  constexpr int kHarmonics = 2;  // further ones are a thousandth of these
  double sum = 0.0;
  for (int k = 1; k <= kHarmonics; ++k) sum += 2.0 * std::abs(averages.harmonic(side, k));
  return 3.0 * sum / (density * kernel.second * kernel.second);
}

double balanced_side(const std::function<double(double side)>& cumulant, double least, double most) {
  // The rule of false position (Illinois): cumulants are smooth.
  double at_least = cumulant(least);
  double at_most = cumulant(most);
  if (at_least > 0.0) return least;
  if (at_most < 0.0) return most;
  while (most - least > 1e-3 * most) {
    const double side = std::clamp(least - at_least * (most - least) / (at_most - at_least),
                                   0.98 * least + 0.02 * most, 0.02 * least + 0.98 * most);
    const double found = cumulant(side);
    if (found > 0.0) {
      most = side;
      at_most = found;
      at_least *= 0.5;
    } else {
      least = side;
      at_least = found;
      at_most *= 0.5;
    }
  }
  return 0.5 * (least + most);
}

double StrataChoice::balanced_side() const {
  if (known_side > 0.0) return known_side;
  const auto cumulant = [&](double side) {
    return weights.fourth * moments.fourth - 3.0 * weights.second * weights.second * averages->overlap(side);
  };
  return solidnoise::balanced_side(cumulant, 0.02 * radius, 4.0 * radius);
}

double StrataChoice::excess_kurtosis(const Strata& strata) const {
  KernelMoments kept = moments;
  kept.overlap = averages->overlap(strata.side);
  return noise_excess_kurtosis(density_of(strata), kept, weights);
}

double StrataChoice::density_of(const Strata& strata) const {
  return strata.count * std::pow(strata.side, -dimensions);
}

double StrataChoice::side_of(double density, int count) const {
  return std::pow(count / density, 1.0 / dimensions);
}

Strata StrataChoice::fewest_balanced() const {
  const double side = balanced_side();
  const double one_per_cube = std::pow(side, -dimensions);
  const double count =
      std::max(1.0, std::ceil(kurtosis_given_place(one_per_cube, moments, *averages, side) / kPlaceKurtosis));
  const double poisson = poisson_density();
  if (count * one_per_cube <= kPlentyOverPoisson * poisson) return of_density(count * one_per_cube);
  const auto over_mean = [&](double one_each) { return excess_kurtosis({one_each, 1}) - kMeanKurtosis; };
  const double enough = solidnoise::balanced_side(over_mean, side_of(kMostOverPoisson * poisson, 1),
                                                  side_of(kPlentyOverPoisson * poisson, 1));
  return of_density(density_of({enough, 1}));
}

Strata StrataChoice::fewest() const {
  const Strata balanced = fewest_balanced();
  if (kurtosis <= kMeanKurtosis) return balanced;
  constexpr int kMostInCube = 8;
  Strata best = balanced;
  for (int count = 1; count <= std::min(kMostInCube, 2 * balanced.count); ++count) {
    const auto over = [&](double side) {
      const double density = density_of({side, count});
      return std::max(excess_kurtosis({side, count}) - kurtosis,
                      solidnoise::kurtosis_given_place(density, moments, *averages, side) - kPlaceKurtosis);
    };
    const double as_many = side_of(density_of(best), count);
    const Strata larger{solidnoise::balanced_side(over, as_many, 4.0 * radius), count};
    if (larger.side > as_many && fits(larger) && excess_kurtosis(larger) >= -kurtosis) best = larger;
  }
  return best;
}

int StrataChoice::halvings(const Strata& strata) const {
  if (strata.count > 1) return 0;
  int halvings = 0;
  while (halvings < kMostHalvings && std::ldexp(strata.side, halvings) < smallest_cell()) ++halvings;
  return halvings;
}

double StrataChoice::poisson_density() const {
  return density_for_excess_kurtosis(kDefaultKurtosis, moments, weights);
}

bool StrataChoice::fits(const Strata& strata) const {
  return std::ldexp(strata.side, halvings(strata)) >= smallest_cell();
}

Strata StrataChoice::of_density(double density) const {
  const auto in_cubes = [&](double side) { return density * std::pow(side, dimensions); };
  const auto of_count = [&](double count) {
    count = std::clamp(count, 1.0, 1e9);
    return Strata{side_of(density, static_cast<int>(count)), static_cast<int>(count)};
  };
  const Strata balanced = of_count(std::round(in_cubes(balanced_side())));
  return fits(balanced) ? balanced : of_count(std::ceil(in_cubes(smallest_cell())));
}

template StrataChoice strata_choice(const IsotropicGaborKernel<1>&, const WeightMoments&);
template StrataChoice strata_choice(const RandomPhaseGaborKernel<1>&);
template StrataChoice strata_choice(const IsotropicGaborKernel<2>&, const WeightMoments&);
template StrataChoice strata_choice(const RandomPhaseGaborKernel<2>&);
template StrataChoice strata_choice(const IsotropicGaborKernel<3>&, const WeightMoments&);
template StrataChoice strata_choice(const RandomPhaseGaborKernel<3>&);
template StrataChoice strata_choice(const IsotropicGaborKernel<4>&, const WeightMoments&);
template StrataChoice strata_choice(const RandomPhaseGaborKernel<4>&);
template StrataChoice strata_choice(const EvenGaborKernel<1>&);
template StrataChoice strata_choice(const EvenGaborKernel<2>&);
template StrataChoice strata_choice(const EvenGaborKernel<3>&);
template StrataChoice strata_choice(const EvenGaborKernel<4>&);
template StrataChoice layer_strata_choice(const IsotropicGaborKernel<2>&, double,
                                          const std::function<double(double)>&);
template StrataChoice layer_strata_choice(const RandomPhaseGaborKernel<2>&, double,
                                          const std::function<double(double)>&);
template StrataChoice layer_strata_choice(const EvenGaborKernel<2>&, double,
                                          const std::function<double(double)>&);

}  // namespace solidnoise
