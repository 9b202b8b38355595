#include "solidnoise/noise/point/scale_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/gabor_noises.h"

namespace solidnoise::scale_layout_test {
namespace {

template <typename Check>
void for_each_choice(const Check& check) {
  for (const GaborWaves waves : {GaborWaves::isotropic, GaborWaves::oriented}) {
    const VaryingGaborOptions options{.frequency = 3.0, .waves = waves};
    SCOPED_TRACE(testing::Message() << "waves " << static_cast<int>(waves));
    check(strata_of<3>(options));
    check(strata_of<4>(options));
  }
}

TEST(ScaleLayout, HasNoExcessKurtosisByDefault) {
  for_each_choice([](const StrataChoice& choice) {
    const ScaleLayout layout = scale_layout(choice, 0.0, ImpulseSpread::strata);
    EXPECT_LT(std::abs(layout.excess_kurtosis(choice, choice.moments)), 0.02);
    EXPECT_LT(layout.kurtosis_given_place(choice), 0.25);
    EXPECT_GT(layout.kurtosis_given_place(choice), 0.0);
  });
}

template <int Dim>
void expect_little_kurtosis(double bandwidth, const WeightMoments& weights) {
  StrataChoice choice = strata_of<Dim>({.frequency = 3.0, .bandwidth = bandwidth});
  choice.weights = weights;
  const ScaleLayout layout = scale_layout(choice, 0.0, ImpulseSpread::strata);
  SCOPED_TRACE(testing::Message() << Dim << "D, bandwidth " << bandwidth << ", E W^4 " << weights.fourth);
  const double over_poisson = layout.effective_density() / choice.poisson_density();
  const bool all = over_poisson > 0.999 * StrataChoice::kMostOverPoisson;
  EXPECT_LT(over_poisson, 1.02 * StrataChoice::kMostOverPoisson);  // whole impulses
  EXPECT_LT(std::abs(layout.excess_kurtosis(choice, choice.moments)), all ? 0.05 : 0.02);
  EXPECT_GE(layout.scale, 2.0 * choice.smallest_cell());
}

// Within the mean that is allowed, or of all impulses that are.
TEST(ScaleLayout, OfNarrowBandsHasLittleKurtosis) {
  for (const double bandwidth : {0.05, 0.1, 0.2, 0.3, 0.5, 1.0}) {
    for (const WeightMoments& weights : {WeightMoments{}, turning({})}) {
      expect_little_kurtosis<2>(bandwidth, weights);
      expect_little_kurtosis<3>(bandwidth, weights);
      expect_little_kurtosis<4>(bandwidth, weights);
    }
  }
}

TEST(ScaleLayout, OfTheDensityThatItHasIsTheSame) {
  for_each_choice([](const StrataChoice& choice) {
    const ScaleLayout layout = scale_layout(choice, 0.0, ImpulseSpread::strata);
    const ScaleLayout again = scale_layout(choice, layout.effective_density(), ImpulseSpread::strata);
    EXPECT_NEAR(again.excess_kurtosis(choice, choice.moments), layout.excess_kurtosis(choice, choice.moments),
                0.02);
    EXPECT_NEAR(again.effective_density() / layout.effective_density(), 1.0, 0.06);  // whole impulses
  });
}

// However many there are: what is evaluated together must not have thousands of cells around it.
TEST(ScaleLayout, CellsOfMoreImpulsesAreNotSmallerThanBalancedOnes) {
  for_each_choice([](const StrataChoice& choice) {
    const double side = choice.balanced_side();
    double kurtosis = 0.0;
    for (double in_balanced = 0.1; in_balanced < 1e5; in_balanced *= 3.0) {
      const double density = in_balanced / std::pow(side, choice.dimensions);
      const ScaleLayout layout = scale_layout(choice, density, ImpulseSpread::strata);
      EXPECT_GE(layout.scale, side);
      EXPECT_GE(layout.effective_density(), 0.999 * density);
      EXPECT_LE(layout.effective_density(), 1.13 * density);
      kurtosis = std::abs(layout.excess_kurtosis(choice, choice.moments));
      EXPECT_LT(kurtosis, in_balanced < 3.0 ? 10.0 : 0.04) << in_balanced;
    }
    EXPECT_LT(kurtosis, 0.002);
  });
}

}  // namespace
}  // namespace solidnoise::scale_layout_test
