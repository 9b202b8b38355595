#include "solidnoise/noise/kernel/impulse_strata.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

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
  constexpr int kLeastMirrored = 3;
  return {.dimensions = dimensions,
          .moments = {kernel.energy(), kernel.fourth_moment()},
          .weights = weights,
          .averages = std::make_shared<RadialAverages>(radial_averages(kernel)),
          .radius = kernel.radius_for_error(kNominalError),
          .mirrored = dimensions >= kLeastMirrored};
}

// Of independent impulses, or a pair of mirrored ones.
Strata one_in_each(double side, bool mirrored) {
  const Cubes cubes{side, mirrored};
  return {cubes, cubes.least()};
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
  constexpr int kLeastMirrored = 4;
  return {.dimensions = Dim,
          .moments = {kernel.energy(), kernel.fourth_moment()},
          .weights = {},
          .averages = averages,
          .radius = kernel.radius_for_error(kNominalError),
          .mirrored = Dim >= kLeastMirrored};
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
  return {.dimensions = 3,
          .moments = {in_plane.energy() * moment(2.0), in_plane.fourth_moment() * moment(4.0)},
          .weights = {},
          .averages = averages,
          .radius = in_plane.radius_for_error(kNominalError),
          .mirrored = !std::is_same_v<Kernel, RandomPhaseGaborKernel<2>>};
}

double kurtosis_given_place(double density, const KernelMoments& kernel, const CubeAverages& averages,
                            const Cubes& cubes) {
  const int harmonics = cubes.mirrored ? 4 : 2;
  double sum = 0.0;
  for (int k = 1; k <= harmonics; ++k) sum += 2.0 * std::abs(averages.harmonic(cubes, k));
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

Strata StrataChoice::balanced(bool in_pairs) const {
  if (known && known->mirrored == in_pairs) return *known;
  const auto cumulant = [&](double side) {
    return weights.fourth * moments.fourth -
           3.0 * weights.second * weights.second * averages->overlap({side, in_pairs});
  };
  return one_in_each(solidnoise::balanced_side(cumulant, 0.02 * radius, 4.0 * radius), in_pairs);
}

StrataChoice StrataChoice::found() const {
  StrataChoice result = *this;
  result.known = balanced();
  return result;
}

double StrataChoice::excess_kurtosis(const Strata& strata) const {
  KernelMoments kept = moments;
  kept.overlap = averages->overlap(strata);
  return noise_excess_kurtosis(density_of(strata), kept, weights);
}

double StrataChoice::given_place(const Strata& strata) const {
  return kurtosis_given_place(density_of(strata), moments, *averages, strata);
}

double StrataChoice::density_of(const Strata& strata) const {
  return strata.count * std::pow(strata.side, -dimensions);
}

double StrataChoice::side_of(double density, int count) const {
  return std::pow(count / density, 1.0 / dimensions);
}

Strata StrataChoice::fewest_balanced() const {
  Strata strata = balanced();
  const int least = strata.least();
  strata.count *= std::max(1, static_cast<int>(std::ceil(given_place(strata) / kPlaceKurtosis)));
  const double poisson = poisson_density();
  if (strata.count > least || density_of(strata) <= poisson) return of_density(density_of(strata));
  const auto over_mean = [&](double side) {
    return excess_kurtosis(one_in_each(side, mirrored)) - kWantedMean;
  };
  const double enough = solidnoise::balanced_side(over_mean, side_of(kMostOverPoisson * poisson, least),
                                                  side_of(poisson, least));
  return of_density(density_of(one_in_each(enough, mirrored)));
}

Strata StrataChoice::fewest() const {
  if (!known) return found().fewest();
  Strata best = fewest_balanced();
  if (kurtosis <= kMeanKurtosis) return best;
  constexpr int kMostInCube = 8;
  const int most = std::min(kMostInCube, 2 * best.count);
  for (int count = best.least(); count <= most; count += best.least()) {
    const auto over = [&](double side) {
      const Strata strata{{side, mirrored}, count};
      return std::max(excess_kurtosis(strata) - kurtosis, given_place(strata) - kPlaceKurtosis);
    };
    const double as_many = side_of(density_of(best), count);
    const Strata larger{{solidnoise::balanced_side(over, as_many, 4.0 * radius), mirrored}, count};
    if (larger.side > as_many && fits(larger) && excess_kurtosis(larger) >= -kurtosis) best = larger;
  }
  return best;
}

int StrataChoice::halvings(const Strata& strata) const {
  if (strata.count > strata.least()) return 0;
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
  const Strata balanced_one = balanced();
  const int least = balanced_one.least();
  const auto in_cubes = [&](double side) { return density * std::pow(side, dimensions) / least; };
  const auto of_count = [&](double count) {
    const int impulses = least * static_cast<int>(std::clamp(count, 1.0, 1e9 / least));
    return Strata{{side_of(density, impulses), mirrored}, impulses};
  };
  const Strata nearest = of_count(std::round(in_cubes(balanced_one.side)));
  return fits(nearest) ? nearest : of_count(std::ceil(in_cubes(smallest_cell())));
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
