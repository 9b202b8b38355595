#include "solidnoise/noise/kernel/impulse_strata.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/point/point_convolution.h"
#include "support/each_dimension.h"

namespace solidnoise::impulse_strata_test {
namespace {

constexpr double kPi = std::numbers::pi;

// The share of the integral of a squared Gaussian's square that cubes of side g / a keep along one axis: the
// mean of sinc^2(f g / a) over frequencies of standard deviation a / sqrt(2 pi), which is
//   erf(sqrt(pi) g) / g - (1 - exp(-pi g^2)) / (pi g^2).
double gaussian_share(double g) {
  return std::erf(std::sqrt(kPi) * g) / g + std::expm1(-kPi * g * g) / (kPi * g * g);
}

// The same of the mean of exp(-4 pi x^2) over x in the side: of places that are each other's mirror image.
double mirrored_share(double g) {
  return std::erf(std::sqrt(kPi) * g) / (2.0 * g);
}

RandomPhaseGaborKernel<3> some_waves() {
  return {1.0, 0.8, Vec<3>(3.0, 0.0, 0.0)};
}

TEST(CubeAverages, OfWavesAreTheClosedForm) {
  const auto kernel = some_waves();
  const StrataChoice choice = strata_choice(kernel);
  for (const double g : {0.1, 0.4, 0.73, 1.5}) {
    const double all = 2.0 / 3.0 * kernel.fourth_moment();
    const double independent = all * std::pow(gaussian_share(g), 3);
    EXPECT_NEAR(choice.averages->overlap({g / kernel.a()}), independent, 1e-3 * independent) << g;
    const double mirrored = 2.0 * independent - all * std::pow(mirrored_share(g), 3);
    EXPECT_NEAR(choice.averages->overlap({g / kernel.a(), true}), mirrored, 1e-3 * independent) << g;
  }
}

// A Gaussian is radial and a product: the two ways are one.
TEST(CubeAverages, OfARadialMeanSquareAreThoseOfTheProduct) {
  const auto square = [](double r) { return std::exp(-2.0 * kPi * r * r); };
  const auto check = [&]<int Dim>() {
    const auto radial = RadialAverages::of(Dim, square, 1.6, 3.2);
    const ProductAverages product(Dim, square, 1.6, 1.0);
    for (const Cubes cubes : {Cubes{0.2}, Cubes{0.7}, Cubes{1.3}, Cubes{0.3, true}, Cubes{1.0, true}}) {
      SCOPED_TRACE(testing::Message() << Dim << "D, side " << cubes.side << ", mirrored " << cubes.mirrored);
      for (const int k : {0, 1, 2, 3}) {
        EXPECT_NEAR(radial.harmonic(cubes, k), product.harmonic(cubes, k), 2e-3 * product.overlap(cubes))
            << k;
      }
    }
  };
  for_each_dimension(check);
}

// Of cubes too small to matter the square of the square is the fourth power.
TEST(CubeAverages, OfTinyCubesAreTheFourthMoment) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.5, 1.0, 2.0}) {
      const EvenGaborKernel<Dim> kernel(gaussian_parameter(1.0, bandwidth), 1.0);
      EXPECT_NEAR(strata_choice(kernel).averages->overlap({1e-3}) / kernel.fourth_moment(), 1.0, 2e-3)
          << Dim << "D, bandwidth " << bandwidth;
    }
  });
}

// The integrals of peaked kernels, which oscillate, against sums over cubes that lie anywhere.
TEST(CubeAverages, AgreeWithSumsOverCubes) {
  const auto kernel = IsotropicGaborKernel<2>::with_unit_peak(2.0, gaussian_parameter(2.0, 1.0));
  const StrataChoice choice = strata_choice(kernel, {});
  const double side = 0.4;
  constexpr int kParts = 40;  // of a cube, along an axis
  constexpr int kCubes = 4;   // on either side
  // The mean of the square in a cube, and of its product at two places of which one is the other's image.
  const auto means_in_cube = [&](double x, double y) {
    const auto square = [&](int i, int j) {
      return std::pow(kernel.value(std::hypot(x + (i + 0.5) * side / kParts, y + (j + 0.5) * side / kParts)),
                      2);
    };
    std::array<double, 2> sums{};
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; j < kParts; ++j) {
        const double here = square(i, j);
        sums[0] += here;
        sums[1] += here * square(kParts - 1 - i, kParts - 1 - j);
      }
    }
    return std::array{sums[0] / (kParts * kParts), sums[1] / (kParts * kParts)};
  };
  // Mean over places along the planes; of the place across them, three harmonics.
  constexpr int kPlaces = 8;
  std::array<double, kPlaces> of_independent{};
  std::array<double, kPlaces> of_mirrored{};
  for (int p = 0; p < kPlaces; ++p) {
    for (int q = 0; q < kPlaces; ++q) {
      for (int i = -kCubes; i < kCubes; ++i) {
        for (int j = -kCubes; j < kCubes; ++j) {
          const auto [mean, product] = means_in_cube((i + static_cast<double>(p) / kPlaces) * side,
                                                     (j + static_cast<double>(q) / kPlaces) * side);
          const double independent = side * side * mean * mean / kPlaces;
          of_independent[static_cast<std::size_t>(p)] += independent;
          of_mirrored[static_cast<std::size_t>(p)] += 2.0 * independent - side * side * product / kPlaces;
        }
      }
    }
  }
  for (const bool mirrored : {false, true}) {
    const auto& at = mirrored ? of_mirrored : of_independent;
    double mean = 0.0;
    for (const double value : at) mean += value / kPlaces;
    EXPECT_NEAR(choice.averages->overlap({side, mirrored}), mean, 2e-3 * mean) << mirrored;
    for (const int k : {1, 2}) {
      double cosine = 0.0;
      for (int p = 0; p < kPlaces; ++p) {
        // The cube's middle is half a side further.
        cosine += at[static_cast<std::size_t>(p)] * std::cos(2.0 * kPi * k * (p + 0.5 * kPlaces) / kPlaces) /
                  kPlaces;
      }
      EXPECT_NEAR(choice.averages->harmonic({side, mirrored}, k), cosine, 3e-3 * mean) << mirrored << k;
    }
  }
}

TEST(StrataChoice, BalancesCubesAtTheKnownSides) {
  // c a of 0.73 in three dimensions, 0.94 in two.
  EXPECT_NEAR(strata_choice(some_waves()).balanced_side() * 0.8, 0.727, 0.002);
  EXPECT_NEAR(strata_choice(RandomPhaseGaborKernel<2>(1.0, 0.8, Vec<2>(1.0))).balanced_side() * 0.8, 0.938,
              0.002);
}

TEST(StrataChoice, TakesTheFewestImpulsesOfLittleKurtosisAnywhere) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.7, 1.0, 2.0}) {
      const auto kernel = IsotropicGaborKernel<Dim>::with_unit_peak(1.0, gaussian_parameter(1.0, bandwidth));
      const StrataChoice choice = strata_choice(kernel, {});
      const Strata strata = choice.fewest();
      const double density = strata.count / std::pow(strata.side, Dim);
      KernelMoments moments = choice.moments;
      moments.overlap = choice.averages->overlap(strata);
      SCOPED_TRACE(testing::Message() << Dim << "D, bandwidth " << bandwidth << ", " << strata.count);
      EXPECT_LT(std::abs(noise_excess_kurtosis(density, moments)), 0.02);
      EXPECT_LE(kurtosis_given_place(density, moments, *choice.averages, strata), 0.25);
      const double one_less = density * (strata.count - strata.least()) / strata.count;
      if (one_less > 0.0) {
        EXPECT_GT(kurtosis_given_place(one_less, moments, *choice.averages, strata), 0.25);
      }
    }
  });
}

// Narrow bands of isotropic kernels, and weights that turn with time, take what 0.02 needs, but no more.
TEST(StrataChoice, NarrowBandsAreWithinTheMeanKurtosis) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.2, 0.3, 0.5, 1.0}) {
      for (const WeightMoments& weights : {WeightMoments{}, turning({})}) {
        const auto kernel =
            IsotropicGaborKernel<Dim>::with_unit_peak(1.0, gaussian_parameter(1.0, bandwidth));
        const StrataChoice choice = strata_choice(kernel, weights);
        const auto kurtosis_of = [&](const Strata& strata) {
          KernelMoments moments = choice.moments;
          moments.overlap = choice.averages->overlap(strata);
          return noise_excess_kurtosis(strata.count / std::pow(strata.side, Dim), moments, weights);
        };
        const Strata strata = choice.fewest();
        SCOPED_TRACE(testing::Message()
                     << Dim << "D, bandwidth " << bandwidth << ", E W^4 " << weights.fourth);
        EXPECT_LT(std::abs(kurtosis_of(strata)), 0.02);
        EXPECT_GE(std::ldexp(strata.side, choice.halvings(strata)), choice.smallest_cell());
        const double over_poisson = strata.count / std::pow(strata.side, Dim) / choice.poisson_density();
        EXPECT_LT(over_poisson, StrataChoice::kMostOverPoisson);
        if (over_poisson > 1.001) {
          EXPECT_EQ(strata.count, strata.least());
          EXPECT_GT(kurtosis_of({{1.01 * strata.side, strata.mirrored}, strata.count}), 0.019);
        }
      }
    }
  });
}

// The more kurtosis is allowed, the fewer impulses, whatever their number in a cube.
TEST(StrataChoice, TakesFewerImpulsesWhereTheMeanMayBeMore) {
  for_each_dimension([]<int Dim>() {
    for (const bool isotropic : {false, true}) {
      const double a = gaussian_parameter(1.0, 1.0);
      StrataChoice choice = isotropic ? strata_choice(IsotropicGaborKernel<Dim>::with_unit_peak(1.0, a), {})
                                      : strata_choice(RandomPhaseGaborKernel<Dim>(1.0, a, Vec<Dim>(0.0)));
      double before = HUGE_VAL;
      for (const double kurtosis : {0.02, 0.05, 0.075, 0.15, 0.25, 0.5}) {
        SCOPED_TRACE(testing::Message() << Dim << "D, isotropic " << isotropic << ", kurtosis " << kurtosis);
        choice.kurtosis = kurtosis;
        const Strata strata = choice.fewest();
        const double density = strata.count / std::pow(strata.side, Dim);
        KernelMoments moments = choice.moments;
        moments.overlap = choice.averages->overlap(strata);
        EXPECT_LT(std::abs(noise_excess_kurtosis(density, moments, choice.weights)), 1.02 * kurtosis);
        const double given_place = kurtosis_given_place(density, moments, *choice.averages, strata);
        EXPECT_LT(given_place, 1.01 * StrataChoice::kPlaceKurtosis);
        EXPECT_LE(density, before);
        before = density;
      }
      EXPECT_LT(before, 0.7 * choice.poisson_density());
    }
  });
}

TEST(StrataChoice, OfADensityHasIt) {
  const StrataChoice choice = strata_choice(some_waves());
  for (const double density : {0.01, 1.0, 3.7, 200.0}) {
    const Strata strata = choice.of_density(density);
    EXPECT_NEAR(strata.count / std::pow(strata.side, 3), density, 1e-12 * density);
    if (strata.count > strata.least()) {
      EXPECT_NEAR(strata.side, choice.balanced().side, 0.2 * choice.balanced().side);
    }
  }
}

// Of isotropic kernels and of waves of phase 0 from three dimensions on, of others from four, and on
// surfaces.
TEST(StrataChoice, MirroredImpulsesBalanceLargerCubes) {
  const auto saved = [](const StrataChoice& choice) {
    const Strata strata = choice.balanced();
    EXPECT_EQ(strata.mirrored, choice.mirrored);
    return choice.density_of(strata) * std::pow(choice.balanced_side(), choice.dimensions);
  };
  const double a = gaussian_parameter(1.0, 1.0);
  EXPECT_NEAR(saved(strata_choice(IsotropicGaborKernel<3>::with_unit_peak(1.0, a), {})), 0.83, 0.01);
  EXPECT_NEAR(saved(strata_choice(EvenGaborKernel<3>(a, 1.0))), 0.71, 0.01);
  EXPECT_NEAR(saved(strata_choice(IsotropicGaborKernel<4>::with_unit_peak(1.0, a), {})), 0.69, 0.01);
  EXPECT_NEAR(saved(strata_choice(EvenGaborKernel<4>(a, 1.0))), 0.54, 0.01);
  EXPECT_NEAR(saved(strata_choice(RandomPhaseGaborKernel<4>(1.0, a, Vec<4>(0.0)))), 0.54, 0.01);
  const auto on_surface = [&](const auto& kernel) {
    return saved(layer_strata_choice(kernel, 0.5 * kernel.radius_for_error(kNominalError), layer_window));
  };
  EXPECT_NEAR(on_surface(IsotropicGaborKernel<2>::with_unit_peak(1.0, a)), 0.78, 0.01);
  EXPECT_NEAR(on_surface(EvenGaborKernel<2>(a, 1.0)), 0.71, 0.01);
  EXPECT_NEAR(saved(strata_choice(EvenGaborKernel<2>(a, 1.0))), 1.0, 1e-12);
  EXPECT_NEAR(saved(strata_choice(RandomPhaseGaborKernel<3>(1.0, a, Vec<3>(0.0)))), 1.0, 1e-12);
}

// Of any kernel what is chosen is what there is of its density: to ask for as many changes nothing.
TEST(StrataChoice, OfItsOwnDensityIsTheFewest) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.1, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0}) {
      const double a = gaussian_parameter(1.0, bandwidth);
      const auto isotropic = IsotropicGaborKernel<Dim>::with_unit_peak(1.0, a);
      for (const StrataChoice& choice : {strata_choice(isotropic, {}), strata_choice(isotropic, turning({})),
                                         strata_choice(RandomPhaseGaborKernel<Dim>(1.0, a, Vec<Dim>(0.0))),
                                         strata_choice(EvenGaborKernel<Dim>(a, 1.0))}) {
        SCOPED_TRACE(testing::Message() << Dim << "D, bandwidth " << bandwidth);
        const Strata fewest = choice.fewest();
        const Strata again = choice.of_density(choice.density_of(fewest));
        EXPECT_EQ(again.count, fewest.count);
        EXPECT_EQ(again.mirrored, fewest.mirrored);
        EXPECT_NEAR(again.side, fewest.side, 1e-12 * fewest.side);
      }
    }
  });
}

// Strata on a line, with weights of 1 and -1: what is left of the fourth cumulant, which is below `most` by
// far enough for this to be a test.
void expect_simulated_kurtosis(const Strata& strata, double most) {
  const auto kernel = IsotropicGaborKernel<1>::with_unit_peak(1.0, gaussian_parameter(1.0, 1.0));
  const StrataChoice choice = strata_choice(kernel, {});
  constexpr int kTrials = 200000;
  RandomStream stream(derive_seed(3, 1));
  double second = 0.0;
  double fourth = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double shift = stream.next_unit();
    double value = 0.0;
    for (int cube = -7; cube < 7; ++cube) {
      double place = 0.0;
      for (int i = 0; i < strata.count; ++i) {
        const double weight = stream.next_unit() < 0.5 ? -1.0 : 1.0;
        place = strata.mirrored && i % 2 == 1 ? 1.0 - place : stream.next_unit();
        value += weight * kernel.value(strata.side * (cube + shift + place));
      }
    }
    second += value * value / kTrials;
    fourth += std::pow(value, 4) / kTrials;
  }
  KernelMoments moments = choice.moments;
  moments.overlap = choice.averages->overlap(strata);
  const double density = strata.count / strata.side;
  const double kurtosis = noise_excess_kurtosis(density, moments);
  // Four standard errors of a Gaussian's; the cumulant here is negative, and tails are shorter.
  EXPECT_NEAR(second / noise_variance(density, kernel.energy()), 1.0, 4.0 * std::sqrt(2.0 / kTrials));
  EXPECT_NEAR(fourth / (second * second) - 3.0, kurtosis, 4.0 * std::sqrt(24.0 / kTrials));
  EXPECT_LT(kurtosis, most);
}

TEST(ImpulseStatistics, KurtosisOfStrataAgreesWithASimulation) {
  expect_simulated_kurtosis({{0.5, false}, 1}, -0.3);
  expect_simulated_kurtosis({{1.0, true}, 2}, -0.4);  // of independent impulses it would be -0.33
  expect_simulated_kurtosis({{0.8, true}, 4}, -0.2);
}

}  // namespace
}  // namespace solidnoise::impulse_strata_test
