#include "solidnoise/field/curl_field.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "reference/curl_reference.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/modify/distance_spline.h"
#include "support/gabor_noises.h"
#include "support/vector_fields.h"

namespace solidnoise::curl_field_test {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

NoiseRecipe isotropic() {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.0, .bounds_gradient = true, .impulses = 30.0, .seed = 5};
  return recipe;
}

NoiseRecipe oriented(double anisotropy = 0.0) {
  NoiseRecipe recipe;
  recipe.noise = OrientedGaborNoiseOptions{.frequency = 1.0, .anisotropy = anisotropy, .seed = 5};
  return recipe;
}

NoiseRecipe two_octaves() {
  NoiseRecipe recipe = oriented();
  recipe.fractal = {.octaves = 2, .lacunarity = 2.0, .gain = 0.5};
  return recipe;
}

NoiseRecipe lattice_noise() {
  NoiseRecipe recipe;
  recipe.noise = GradientNoiseOptions{.frequency = 1.0};
  return recipe;
}

CurlOptions curl_of(const NoiseRecipe& recipe, const Vec<3>& moved = Vec<3>(0.0)) {
  CurlOptions options;
  for (int c = 0; c < 3; ++c) {
    options.potentials[static_cast<std::size_t>(c)] =
        move_noise<3>(make_noise<3>(channel_of(recipe, c)), moved);
  }
  return options;
}

double mean_square(const std::vector<float>& values, std::size_t samples) {
  double sum = 0.0;
  for (const float value : values) sum += static_cast<double>(value) * value;
  return sum / static_cast<double>(samples);
}

// The root mean square of the divergence by central differences, at scattered places of which `wanted` holds.
template <typename Wanted>
double rms_divergence(const Field<3>& field, double step, const Wanted& wanted) {
  RandomStream stream(3);
  const auto velocity = [&](const Vec<3>& p) { return vector_at(field, p); };
  double sum = 0.0;
  int count = 0;
  while (count < 150) {
    const Vec<3> p(3.0 * stream.next_unit(), 3.0 * stream.next_unit(), 3.0 * stream.next_unit());
    if (!wanted(p)) continue;
    sum += std::pow(divergence(velocity, p, step), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(CurlField, HasTheSpeedOfTheClosedForm) {
  for (const NoiseRecipe& recipe : {isotropic(), oriented(), oriented(1.0), two_octaves(), lattice_noise()}) {
    SCOPED_TRACE(testing::Message() << recipe.noise.index() << ", octaves " << recipe.fractal.octaves);
    CurlOptions options = curl_of(recipe);
    options.speed = 2.5;
    Lattice<3> lattice;
    lattice.step = Vec<3>(0.737);  // not commensurate with the gradients' lattice
    lattice.count = {24, 24, 24};
    const double measured = mean_square(channels_on(*make_curl_field(options), lattice), lattice.size());
    // Samples 0.7 waves apart: a few thousand independent ones of |v|^2, whose relative standard deviation is
    // about 1.3 for Gaussian fields of two or three components and 1.5 with the kurtosis here: 4 of
    // 1.5 / sqrt(5000).
    EXPECT_NEAR(measured, 2.5 * 2.5, 0.085 * 2.5 * 2.5);
  }
}

// Value and derivatives of the library are held to the reference elsewhere; here the curl is, and that in
// double precision it has no divergence.
TEST(CurlField, IsTheReferencesCurlWhichHasNoDivergence) {
  std::array<std::unique_ptr<GaborNoise<3>>, 3> noises;
  for (int c = 0; c < 3; ++c) {
    noises[static_cast<std::size_t>(c)] = std::make_unique<GaborNoise<3>>(
        with_truncation_share(std::get<GaborNoiseOptions>(channel_of(isotropic(), c).noise)));
  }
  const auto field = make_curl_field(curl_of(isotropic()));
  // All three have the same statistics: E|v|^2 is twice that of a gradient.
  const double scale = 1.0 / std::sqrt(6.0 * noises[0]->gradient_variance().x);
  constexpr double kStep = 2e-4;
  int smooth = 0;
  RandomStream stream(8);
  for (int i = 0; i < 40; ++i) {
    const Vec<3> p(9.0 * stream.next_unit(), 9.0 * stream.next_unit(), -9.0 * stream.next_unit());
    const auto derivative_of = [&](std::size_t c) {
      return [&, c](int axis, const reference::Position<3>& d, const reference::Impulse<3>& impulse) {
        return IsotropicReference<3>{*noises[c]}.derivative(axis, d, impulse);
      };
    };
    using Derivative = decltype(derivative_of(0));
    const auto potential = [&](std::size_t c) {
      return reference::Potential<Derivative>{impulses_near(*noises[c], p, 1), derivative_of(c),
                                              scale * noises[c]->amplitude()};
    };
    const std::array<reference::Potential<Derivative>, 3> psi{potential(0), potential(1), potential(2)};
    const auto velocity = [&](const reference::Position<3>& offset) { return reference::curl(psi, offset); };

    const Vec<3> found = vector_at(*field, p);
    const auto expected = velocity({});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(found[static_cast<int>(axis)], expected[axis], 1e-5);
    }
    // The kernels' fifth derivatives, which bound the error of differences, are large at their radius.
    bool crosses = false;
    for (const auto& part : psi) {
      for (const auto& impulse : part.impulses) {
        crosses = crosses || std::abs(length<3>(impulse.position) - noises[0]->radius()) < 3.0 * kStep;
      }
    }
    if (crosses) continue;
    ++smooth;
    // Of fourth order: about (2 pi step)^4 / 30 of the derivatives, which are about 2 pi.
    EXPECT_NEAR(reference::divergence(velocity, kStep), 0.0, 1e-9 * kTau);
  }
  EXPECT_GT(smooth, 10);
}

const auto kAnywhere = [](const Vec<3>&) { return true; };

TEST(CurlField, HasADiscreteDivergenceOfTheStencilsOrder) {
  for (const NoiseRecipe& recipe : {isotropic(), oriented(), oriented(1.0), two_octaves(), lattice_noise()}) {
    SCOPED_TRACE(testing::Message() << recipe.noise.index() << ", octaves " << recipe.fractal.octaves);
    const auto field = make_curl_field(curl_of(recipe));
    const double scale = recipe.fractal.octaves;
    const double coarse = rms_divergence(*field, 1.0 / (16.0 * scale), kAnywhere);
    const double fine = rms_divergence(*field, 1.0 / (32.0 * scale), kAnywhere);
    // Half the step, a quarter of the error; terms of fourth order are (2 pi / 16)^2 / 20 of it, and more at
    // the band's upper end.
    EXPECT_NEAR(coarse / fine, 4.0, 0.35) << coarse << ' ' << fine;
    EXPECT_LT(fine, 0.004 * kTau * scale);
  }
}

// Where kernels end, third derivatives are continuous: the velocity's differences, of second order, stay so
// at steps far below a wave. With a jump there the factor would be 2.8.
TEST(CurlField, OfIsotropicKernelsHasThatOrderAtFineStepsToo) {
  const auto field = make_curl_field(curl_of(isotropic()));
  double coarse = rms_divergence(*field, 1.0 / 32.0, kAnywhere);
  for (const double steps : {64.0, 128.0}) {
    const double fine = rms_divergence(*field, 1.0 / steps, kAnywhere);
    EXPECT_NEAR(coarse / fine, 4.0, 0.3) << steps << ' ' << coarse << ' ' << fine;
    coarse = fine;
  }
}

TEST(CurlField, IsTheSameFarFromTheOrigin) {
  // All positions are exact in binary: the field and its positions moved by 2^20 give the same bits.
  const auto near = make_curl_field(curl_of(oriented()));
  const Vec<3> far(1048576.0, -1048576.0, 524288.0);
  const auto moved = make_curl_field(curl_of(oriented(), far));
  Lattice<3> lattice;
  lattice.step = Vec<3>(0.0625);
  lattice.first = Index<3>(-5, 3, 0);
  lattice.count = {8, 8, 8};
  const std::vector<float> here = channels_on(*near, lattice);
  lattice.origin = far;
  EXPECT_EQ(channels_on(*moved, lattice), here);

  // And the field that stays is as smooth there as here: second differences over a 256th of a wave, which
  // float positions, an eighth apart there, would make jumps.
  const auto roughness = [&](const Vec<3>& origin) {
    Lattice<3> line;
    line.origin = origin;
    line.step = Vec<3>(1.0 / 256.0);
    line.count = {1, 1, 512};
    const std::vector<float> v = channels_on(*near, line);
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < 512; ++i) sum += std::pow(v[i + 1] - 2.0 * v[i] + v[i - 1], 2);
    return std::sqrt(sum / 510.0);
  };
  // 1 wave / 256: (2 pi / 256)^2 = 6e-4 of the component's 0.58.
  EXPECT_LT(roughness({1.0e6, -1.0e6, 1.0e6}), 1.5e-3);
  EXPECT_LT(roughness(Vec<3>(0.0)), 1.5e-3);
}

TEST(CurlField, RefusesSpeedsThatAreNone) {
  CurlOptions options = curl_of(oriented());
  for (const double speed : {0.0, -1.0, std::nan("")}) {
    options.speed = speed;
    EXPECT_THROW(make_curl_field(options), std::invalid_argument);
  }
  EXPECT_THROW(make_curl_field(CurlOptions{}), std::invalid_argument);
}

const Vec<3> kCentre(1.5, 1.4, 1.6);
constexpr double kRadius = 1.0;
constexpr double kWidth = 0.5;

std::shared_ptr<const DistanceSpline> sphere(double voxel) {
  const openvdb::FloatGrid::ConstPtr level_set = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      static_cast<float>(kRadius), openvdb::Vec3f(1.5f, 1.4f, 1.6f), static_cast<float>(voxel));
  return std::make_shared<DistanceSpline>(level_set, kWidth);
}

CurlOptions around_sphere(double voxel) {
  CurlOptions options = curl_of(oriented());
  options.boundary = sphere(voxel);
  return options;
}

double distance_to_sphere(const Vec<3>& p) {
  return glm::length(p - kCentre) - kRadius;
}

Vec<3> random_direction(RandomStream& stream) {
  const double height = 2.0 * stream.next_unit() - 1.0;
  const double azimuth = kTau * stream.next_unit();
  const double width = std::sqrt(1.0 - height * height);
  return {width * std::cos(azimuth), width * std::sin(azimuth), height};
}

// Where the spline is 0 the velocity is tangential to it, to rounding; and nothing stands still.
TEST(CurlField, DoesNotCrossTheBoundary) {
  const CurlOptions options = around_sphere(0.1);
  const auto field = make_curl_field(options);
  const auto jet_at = [&](const Vec<3>& position) {
    SmoothDistance::Jet jet;
    options.boundary->evaluate({&position, 1}, {&jet, 1});
    return jet;
  };
  RandomStream stream(2);
  double tangential = 0.0;
  for (int i = 0; i < 200; ++i) {
    Vec<3> p = kCentre + kRadius * random_direction(stream);
    for (int step = 0; step < 5; ++step) {
      const auto jet = jet_at(p);
      p -= jet.distance / glm::dot(jet.gradient, jet.gradient) * jet.gradient;
    }
    const Vec<3> v = vector_at(*field, p);
    EXPECT_NEAR(glm::dot(v, glm::normalize(jet_at(p).gradient)), 0.0, 2e-6);
    tangential += glm::dot(v, v) / 200.0;
  }
  EXPECT_GT(std::sqrt(tangential), 0.3);
}

// On the sphere itself the rest is what the spline's surface is off: of second order in the voxel's size.
TEST(CurlField, HasANormalComponentOfSecondOrderOnTheSurface) {
  const auto normal_speed = [&](double voxel) {
    const auto field = make_curl_field(around_sphere(voxel));
    RandomStream stream(2);
    double sum = 0.0;
    for (int i = 0; i < 300; ++i) {
      const Vec<3> normal = random_direction(stream);
      sum += std::pow(glm::dot(vector_at(*field, kCentre + kRadius * normal), normal), 2);
    }
    return std::sqrt(sum / 300.0);
  };
  const double coarse = normal_speed(0.1);
  const double fine = normal_speed(0.05);
  // The rebuilt spline is 0.8 h^2 / R inside, and the normal component grows by 15/8 of the speed in a width:
  // 0.008 * 3.75, of which the normal has a part.
  EXPECT_LT(coarse, 0.03);
  EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

TEST(CurlField, IsWithoutDivergenceNearTheBoundaryToo) {
  const auto field = make_curl_field(around_sphere(0.1));
  // Not across the surface, where derivatives have a step, nor beyond the ramp.
  const auto in_ramp = [](const Vec<3>& p) {
    const double d = std::abs(distance_to_sphere(p));
    return d > 0.08 && d < kWidth;
  };
  const double coarse = rms_divergence(*field, 1.0 / 32.0, in_ramp);
  const double fine = rms_divergence(*field, 1.0 / 64.0, in_ramp);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6) << coarse << ' ' << fine;
  EXPECT_LT(fine, 0.02 * kTau);
}

TEST(CurlField, IsTheSameBeyondTheRampAndContinuousAcrossIt) {
  const auto bounded = make_curl_field(around_sphere(0.1));
  const auto plain = make_curl_field(curl_of(oriented()));
  RandomStream stream(2);
  for (int i = 0; i < 50; ++i) {
    const Vec<3> normal = random_direction(stream);
    const auto difference = [&](double radius) {
      return vector_at(*bounded, kCentre + radius * normal) - vector_at(*plain, kCentre + radius * normal);
    };
    EXPECT_EQ(difference(kRadius + kWidth + 0.01), Vec<3>(0.0));
    // At the ramp's end the rest is of second order in the distance to it.
    EXPECT_LT(glm::length(difference(kRadius + kWidth - 0.01)), 0.02);
    const auto step = [&](double radius) {
      return glm::length(vector_at(*bounded, kCentre + (radius + 1e-4) * normal) -
                         vector_at(*bounded, kCentre + (radius - 1e-4) * normal));
    };
    EXPECT_LT(step(kRadius), 2e-4 * 10.0 * kTau);
    EXPECT_LT(step(kRadius - kWidth), 2e-4 * 10.0 * kTau);
  }
}

}  // namespace
}  // namespace solidnoise::curl_field_test
