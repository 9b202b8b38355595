// Planes through a noise: the same values, and the statistics of what is on the plane.
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/evaluated.h"
#include "support/spectra.h"

namespace solidnoise::plane_noise_test {
namespace {

using NoisePtr = std::shared_ptr<const Noise<3>>;

std::vector<Plane> some_planes() {
  const Vec<3> right = glm::normalize(Vec<3>(2.0, -1.0, 0.5));
  const Vec<3> up = glm::normalize(glm::cross(right, Vec<3>(0.3, 0.2, 1.0)));
  const Vec<3> origin(0.3, -7.1, 2.2);
  return {{origin, {1, 0, 0}, {0, 1, 0}},
          {origin, {1, 0, 0}, {0, 0, 1}},
          {origin, {0, 1, 0}, {0, 0, 1}},
          {origin, {0, 0, -1}, {0, 1, 0}},
          {origin, right, up}};
}

std::vector<NoisePtr> some_noises() {
  NoiseRecipe octaves{GaborNoiseOptions{.frequency = 1.0, .impulses = 20.0}, {}};
  octaves.fractal.octaves = 2;
  return {make_noise<3>(octaves),
          make_noise<3>({OrientedGaborNoiseOptions{
                             .frequency = 1.0, .anisotropy = 0.6, .direction = Vec<4>(0.5, 1.0, -0.2, 0.0)},
                         {}}),
          std::make_shared<const SpectrumNoise<3>>(some_spectrum(3))};
}

// As at the points of space. Planes along the axes are evaluated as lattices, the same to the last bit; on
// others positions are rounded to single precision relative to the first.
TEST(PlaneNoise, IsTheNoiseOnThePlane) {
  for (const NoisePtr& noise : some_noises()) {
    const double length = 1.0 / noise->band().upper;
    for (const Plane& plane : some_planes()) {
      const auto flat = on_plane(noise, plane);
      const Lattice<2> lattice{Vec<2>(0.25 * length), Vec<2>(0.3 * length, 0.2 * length), {-2, 3}, {9, 7}};
      const Evaluated<2> made = evaluate_in_one_block<2>(*flat, lattice);
      for (std::size_t i = 0; i < lattice.size(); ++i) {
        const Vec<2> x = sample_position(lattice, i);
        const Lattice<3> there{plane.origin + x.x * plane.right + x.y * plane.up, Vec<3>(1.0), {}, {1, 1, 1}};
        const Evaluated<3> expected = evaluate_in_one_block<3>(*noise, there);
        const Vec<3> slope(expected.gradient[0][0], expected.gradient[1][0], expected.gradient[2][0]);
        EXPECT_NEAR(made.values[i], expected.values[0], 1e-4);
        EXPECT_NEAR(made.gradient[0][i] * length, glm::dot(slope, plane.right) * length, 1e-3);
        EXPECT_NEAR(made.gradient[1][i] * length, glm::dot(slope, plane.up) * length, 1e-3);
      }
    }
  }
}

TEST(PlaneNoise, HasTheCovarianceOfThePlane) {
  for (const NoisePtr& noise : some_noises()) {
    for (const Plane& plane : some_planes()) {
      const auto flat = on_plane(noise, plane);
      for (const Vec<2>& x : {Vec<2>(0.0), Vec<2>(0.3, 0.1), Vec<2>(-0.4, 0.5), Vec<2>(1.1, 0.2)}) {
        const Vec<2> scaled = x / noise->band().upper;
        EXPECT_NEAR(flat->covariance(scaled), noise->covariance(scaled.x * plane.right + scaled.y * plane.up),
                    1e-9);
      }
    }
  }
}

// An isotropic noise has the same spectrum on all planes: its integral is the variance, and that of
// (2 pi f_x)^2 times it, half that of (2 pi f)^2, the variance of the derivative. Compact kernels have a
// little more of both than the waves of the mixture.
TEST(PlaneNoise, HasTheSpectrumOfThePlane) {
  const NoisePtr noise = make_noise<3>({GaborNoiseOptions{.frequency = 1.0, .error = 1e-3}, {}});
  const auto flat = on_plane(noise, some_planes().back());
  const Vec<2> direction(0.6, -0.8);
  const auto moment = [&](int power) {
    return integrate(
        [&](double f) {
          const double turns = 2.0 * std::numbers::pi * f;
          return turns * std::pow(turns, power) * flat->power_spectrum(f * direction);
        },
        0.0, 1.3 * noise->band().upper, 8);
  };
  EXPECT_NEAR(moment(0), flat->variance(), 2e-3);
  EXPECT_NEAR(0.5 * moment(2), flat->gradient_variance().x, 0.005 * flat->gradient_variance().x);
}

// Of twelve octaves, too, though the bands of the lowest are a thousandth of the whole: at low frequencies
// the spectrum is that of the lowest octave, times its share, and what planes have of the others.
TEST(PlaneNoise, HasTheSpectrumOfAllOctaves) {
  NoiseRecipe recipe{GaborNoiseOptions{.frequency = 1.0}, {}};
  recipe.fractal.octaves = 12;
  const NoisePtr noise = make_noise<3>(recipe);
  const Plane plane = some_planes().back();
  for (const Vec<2> frequency : {Vec<2>(0.7, 0.0), Vec<2>(0.6, -0.8)}) {
    double sum = 0.0;
    for (const auto& part : noise->parts())
      sum += std::pow(part.amplitude, 2) * on_plane(part.noise, plane)->power_spectrum(frequency);
    EXPECT_NEAR(on_plane(noise, plane)->power_spectrum(frequency) / sum, 1.0, 1e-9);
  }
}

// Interpolated on its lattice it is the noise but for the error and what compact kernels have of frequencies
// beyond the band, whatever the strip.
TEST(PlaneNoise, IsInterpolated) {
  for (const NoisePtr& noise : some_noises()) {
    const double step = 0.05 / noise->band().upper;
    for (const Plane& plane : some_planes()) {
      const std::shared_ptr<const Noise<2>> flat = on_plane(noise, plane);
      const LatticeFrame<2> frame{Vec<2>(0.0), Vec<2>(step)};
      const auto interpolated = interpolate<2>(flat, frame, 0.01);
      ASSERT_NE(interpolated, flat);
      const Lattice<2> whole{frame.origin, frame.step, {0, 0}, {90, 120}};
      const auto made = evaluate_in_one_block<2>(*interpolated, whole);
      const auto expected = evaluate_in_one_block<2>(*flat, whole);
      double squares = 0.0;
      for (std::size_t i = 0; i < whole.size(); ++i) {
        squares += std::pow(double(made.values[i]) - double(expected.values[i]), 2);
      }
      EXPECT_LT(std::sqrt(squares / static_cast<double>(whole.size()) / noise->variance()), 0.01 + 0.02);
      Lattice<2> strip = whole;
      strip.first.x = 31;
      strip.count.x = 17;
      const auto anew = interpolate<2>(flat, frame, 0.01);
      const auto part = evaluate_in_one_block<2>(*anew, strip);
      for (std::size_t i = 0; i < strip.size(); ++i) {
        ASSERT_EQ(part.values[i], made.values[31 * 120 + i]) << "sample " << i;
      }
    }
  }
}

}  // namespace
}  // namespace solidnoise::plane_noise_test
