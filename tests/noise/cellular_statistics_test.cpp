#include "solidnoise/noise/cellular/cellular_statistics.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/cellular/cellular_noise.h"
#include "support/each_dimension.h"

namespace solidnoise::cellular_statistics_test {
namespace {

using Feature = CellularNoiseOptions::Feature;

constexpr Feature kFeatures[] = {Feature::distance, Feature::border};

// Two roads to the same numbers: the variance by the moments of the two distances is the covariance at 0,
// and the integral of the spectrum; the gradient's variance, by the directions to the points, is the
// covariance's curvature at 0.
TEST(CellularStatistics, ClosedFormsAgreeWithEachOther) {
  for_each_dimension([]<int Dim>() {
    for (const Feature feature : kFeatures) {
      SCOPED_TRACE(static_cast<int>(feature));
      const CellularStatistics<Dim> statistics(feature);
      const double variance = statistics.variance();
      EXPECT_NEAR(statistics.covariance(0.0), variance, 1e-4 * variance);
      EXPECT_EQ(statistics.covariance(1e3), 0.0);

      // Beyond 40 the power, falling as f^-3 there, has less than 1e-4 of the variance.
      double power = 0.0;
      for (double f = 0.0; f < 40.0; f += 0.125) {
        power += unit_sphere_area(Dim) *
                 integrate([&](double g) { return std::pow(g, Dim - 1) * statistics.power_spectrum(g); }, f,
                           f + 0.125);
      }
      EXPECT_NEAR(power, variance, 2e-4 * variance);

      // C(d) = C(0) - g d^2 / 2 + k |d|^3 + ...: the second differences of two steps leave the cube out.
      const auto curvature = [&](double h) {
        return 2.0 * (statistics.covariance(0.0) - statistics.covariance(h)) / (h * h);
      };
      const double extrapolated = 2.0 * curvature(0.01) - curvature(0.02);
      EXPECT_NEAR(extrapolated, statistics.gradient_variance(), 0.01 * statistics.gradient_variance());

      const Band band = statistics.band();
      EXPECT_GT(band.lower, 0.0);
      EXPECT_GT(band.upper, 2.0);
      EXPECT_LT(band.upper, 20.0);
    }
  });
}

// Known elsewhere: in one dimension both distances' forms are exponentials. The gap to the nearest of points
// on a line is exponential of rate 2, and so, by the lack of memory, is the second's excess.
TEST(CellularStatistics, AreExponentialsOnALine) {
  for (const Feature feature : kFeatures) {
    const CellularStatistics<1> statistics(feature);
    EXPECT_NEAR(statistics.mean(), 0.5, 1e-14);
    EXPECT_NEAR(statistics.variance(), 0.25, 1e-14);
    EXPECT_NEAR(statistics.excess_kurtosis(), 6.0, 1e-12);
  }
}

// Of pairs of places at a distance, over seeds; each pair in a noise of its own, so that all are independent.
TEST(CellularStatistics, AreThoseOfTheNoise) {
  for_each_dimension([]<int Dim>() {
    for (const Feature feature : kFeatures) {
      SCOPED_TRACE(static_cast<int>(feature));
      constexpr int kPairs = 20000;
      constexpr double kDistance = 0.6;
      const CellularStatistics<Dim> statistics(feature);
      // Far apart in one noise: 40 cells, where the covariance is below 1e-13.
      const CellularNoise<Dim> noise({.frequency = 1.0, .feature = feature, .seed = 77});
      std::vector<Vec<Dim>> places;
      RandomStream random(derive_seed(4, Dim));
      for (int pair = 0; pair < kPairs; ++pair) {
        Vec<Dim> place(0.0);
        for (int axis = 0; axis < Dim; ++axis) place[axis] = random.next_unit();
        place[0] += 40.0 * pair;
        places.push_back(place);
        place[pair % Dim] += kDistance;
        places.push_back(place);
      }
      std::vector<float> values(places.size());
      noise.evaluate(Points<Dim>{places}, {values, {}});

      // Within 4.5 standard errors, as measured: 7e-6 of false alarms each, 2e-4 of one in all 32.
      const auto expect_mean = [&](const auto& of_pair, double expected, const char* what) {
        double sum = 0.0;
        double squares = 0.0;
        for (std::size_t i = 0; i < values.size(); i += 2) {
          const double value = of_pair(values[i], values[i + 1]);
          sum += value;
          squares += value * value;
        }
        const double mean = sum / kPairs;
        const double error = std::sqrt((squares / kPairs - mean * mean) / kPairs);
        EXPECT_NEAR(mean, expected, 4.5 * error) << what;
      };
      expect_mean([](double a, double) { return a; }, 0.0, "mean");
      expect_mean([](double a, double) { return a * a; }, 1.0, "variance");
      expect_mean([](double a, double) { return std::pow(a, 4); }, statistics.excess_kurtosis() + 3.0,
                  "fourth moment");
      expect_mean([](double a, double b) { return a * b; },
                  statistics.covariance(kDistance) / statistics.variance(), "covariance");
    }
  });
}

}  // namespace
}  // namespace solidnoise::cellular_statistics_test
