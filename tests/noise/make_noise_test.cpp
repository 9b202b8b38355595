// One road to a noise: what a recipe makes is what its options make, to within their error.
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"

namespace solidnoise::make_noise_test {
namespace {

// Of the values of two noises: E[(a - b)^2] / E[a^2], its root.
template <int Dim>
double relative_difference(const Noise<Dim>& a, const Noise<Dim>& b) {
  Lattice<Dim> lattice;
  lattice.step = Vec<Dim>(0.37);
  lattice.first = Index<Dim>(-5);
  lattice.count = Index<Dim>(Dim == 4 ? 9 : Dim == 3 ? 18 : 70);
  const std::vector<float> of_a = evaluate_in_one_block<Dim>(a, lattice).values;
  const std::vector<float> of_b = evaluate_in_one_block<Dim>(b, lattice).values;
  double difference = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const double x = of_a[i];
    difference += std::pow(x - static_cast<double>(of_b[i]), 2);
    square += x * x;
  }
  return std::sqrt(difference / square);
}

// Kernels have their share of the error only, from the same impulses.
template <int Dim>
void expect_one_noise() {
  SCOPED_TRACE(Dim);
  const GaborNoiseOptions isotropic{.frequency = 1.0, .seed = 7};
  EXPECT_LT(relative_difference<Dim>(GaborNoise<Dim>(isotropic), *make_noise<Dim>({isotropic, {}})),
            1.5 * isotropic.error);
  for (const double anisotropy : {0.0, 1.0}) {
    const OrientedGaborNoiseOptions oriented{.frequency = 1.0, .anisotropy = anisotropy, .seed = 7};
    EXPECT_LT(relative_difference<Dim>(OrientedGaborNoise<Dim>(oriented), *make_noise<Dim>({oriented, {}})),
              1.5 * oriented.error);
  }
  const GradientNoiseOptions gradient{.frequency = 1.0, .seed = 7};
  EXPECT_EQ(relative_difference<Dim>(GradientNoise<Dim>(gradient), *make_noise<Dim>({gradient, {}})), 0.0);
  // Another noise is another.
  GaborNoiseOptions other = isotropic;
  other.seed = 8;
  EXPECT_GT(relative_difference<Dim>(GaborNoise<Dim>(isotropic), *make_noise<Dim>({other, {}})), 0.8);
}

TEST(MakeNoise, MakesTheNoiseOfItsOptions) {
  expect_one_noise<2>();
  expect_one_noise<3>();
  expect_one_noise<4>();
}

}  // namespace
}  // namespace solidnoise::make_noise_test
