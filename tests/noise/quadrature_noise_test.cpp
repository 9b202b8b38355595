#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/message_of.h"

namespace solidnoise::quadrature_noise_test {
namespace {

NoiseRecipe oriented(double anisotropy) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{
      .frequency = 1.0, .anisotropy = anisotropy, .direction = {0.6, -0.3, 1.0, 0.0}, .seed = 4};
  return recipe;
}

// The imaginary part by the reference: the noise's own impulses with sin in place of cos.
TEST(QuadratureNoise, HasTheNoisesImpulsesWithSineForCosine) {
  for (const double anisotropy : {0.0, 0.7}) {
    const NoiseRecipe recipe = oriented(anisotropy);
    const OrientedGaborNoise<3> noise(
        with_truncation_share(std::get<OrientedGaborNoiseOptions>(recipe.noise)));
    const auto quadrature = make_quadrature<3>(recipe);
    const Lattice<3> lattice = some_lattice<3>(noise.envelope().radius());
    const Evaluated<3> evaluated = evaluate_in_one_block<3>(*quadrature, lattice);
    const OrientedReference<3> kernel{noise};
    for (std::size_t sample = 0; sample < lattice.size(); sample += 37) {
      double expected = 0.0;
      for (const auto& impulse : impulses_near(noise, sample_position(lattice, sample), 1)) {
        reference::Position<3> offset;
        for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] = -impulse.position[axis];
        expected += kernel.envelope(offset, -1) * std::sin(wave_angle<3>(offset, impulse));
      }
      // Single precision, of some hundred terms.
      EXPECT_NEAR(evaluated.values[sample], noise.amplitude() * expected, 2e-5);
    }
  }
}

TEST(QuadratureNoise, IsUncorrelatedWithTheNoiseAndOfTheSameVariance) {
  const NoiseRecipe recipe = oriented(0.0);
  const auto real = make_noise<3>(recipe);
  const auto imaginary = make_quadrature<3>(recipe);
  EXPECT_EQ(imaginary->variance(), 1.0);
  // Samples a unit apart are almost independent: 20^3 of them.
  Lattice<3> lattice;
  lattice.count = {20, 20, 20};
  const auto re = evaluate_in_one_block<3>(*real, lattice).values;
  const auto im = evaluate_in_one_block<3>(*imaginary, lattice).values;
  double re_re = 0.0;
  double im_im = 0.0;
  double re_im = 0.0;
  for (std::size_t i = 0; i < re.size(); ++i) {
    re_re += re[i] * re[i];
    im_im += im[i] * im[i];
    re_im += re[i] * im[i];
  }
  const double count = static_cast<double>(re.size());
  // Standard deviations about sqrt(2.5 / n) = 0.018 and sqrt(1 / n) = 0.011, or 1.3 times that as neighbours
  // correlate a little; 4 of them.
  EXPECT_NEAR(re_re / count, 1.0, 0.09);
  EXPECT_NEAR(im_im / count, 1.0, 0.09);
  EXPECT_NEAR(re_im / count, 0.0, 0.06);
}

TEST(QuadratureNoise, NeedsOrientedGaborNoiseOfOneOctave) {
  NoiseRecipe recipe;
  EXPECT_NE(message_of<std::invalid_argument>([&] { make_quadrature<3>(recipe); }).find("gabor-oriented"),
            std::string::npos);
  recipe = oriented(0.0);
  recipe.fractal.octaves = 2;
  EXPECT_NE(message_of<std::invalid_argument>([&] { make_quadrature<3>(recipe); }).find("octaves is 2"),
            std::string::npos);
}

}  // namespace
}  // namespace solidnoise::quadrature_noise_test
