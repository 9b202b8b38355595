#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/core/numerics.h"
#include "solidnoise/noise/noise_views.h"
#include "support/each_dimension.h"
#include "support/gabor_noises.h"
#include "support/tile_spectrum.h"

namespace solidnoise::gabor_spectrum_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Tiles for frequency 1: a period that kernels of one octave fit in, and 8 samples per cycle, so that the
// spectrum above 4, that is the aliases, is below 1e-6 of its peak. 4D tiles would be too large; 4D is seen
// through its frames.
template <int Dim>
struct Tiles {
  static constexpr double kPeriod = std::array{16.0, 8.0, 5.0}[Dim - 1];
  static constexpr int kSide = static_cast<int>(8 * kPeriod);
  static constexpr int kCount = std::array{150, 40, 20}[Dim - 1];
};

GaborNoiseOptions isotropic_options(double period) {
  GaborNoiseOptions options;
  options.frequency = 1.0;
  options.impulses = 150.0;
  options.period = Vec<4>(period);
  return options;
}

OrientedGaborNoiseOptions oriented_options(double period, double anisotropy) {
  OrientedGaborNoiseOptions options;
  options.frequency = 1.0;
  options.impulses = 150.0;
  options.anisotropy = anisotropy;
  options.direction = Vec<4>(0.8, -0.3, 0.55, 0.0);
  options.period = Vec<4>(period);
  return options;
}

template <int Dim, typename MakeNoise>
void add_tiles(TileSpectrum<Dim>& spectrum, const MakeNoise& noise_of_seed) {
  for (int seed = 0; seed < Tiles<Dim>::kCount; ++seed) {
    spectrum.add(*noise_of_seed(static_cast<std::uint64_t>(seed)));
  }
}

template <int Dim>
double impulses_in_tile(double density) {
  return density * std::pow(Tiles<Dim>::kPeriod, Dim);
}

// Bins by |k|, from the lowest frequencies to twice the principal one, where 1e-4 of the power is left.
template <int Dim>
int radial_bins() {
  return static_cast<int>(2.0 * Tiles<Dim>::kPeriod);
}
template <int Dim>
int radial_bin(const WaveNumber<Dim>& k) {
  return static_cast<int>(glm::length(Vec<Dim>(k)) + 0.5) - 1;
}

template <typename Check>
void for_one_to_three_dimensions(const Check& check) {
  for_each_dimension([&]<int Dim>() {
    if constexpr (Dim < 4) check.template operator()<Dim>();
  });
}

TEST(GaborSpectrum, OfIsotropicKernelsIsTheClosedFormPerRadialBin) {
  for_one_to_three_dimensions([]<int Dim>() {
    auto options = isotropic_options(Tiles<Dim>::kPeriod);
    const GaborNoise<Dim> noise(options);
    RadialMemo radial([&](double f) {
      Vec<Dim> frequency(0.0);
      frequency[0] = f;
      return noise.power_spectrum(frequency);
    });
    TileSpectrum<Dim> spectrum(Tiles<Dim>::kSide, Tiles<Dim>::kPeriod);
    spectrum.set_bins(radial_bins<Dim>(), radial_bin<Dim>, [&](const Vec<Dim>& f) { return radial(f); });
    add_tiles<Dim>(spectrum, [&](std::uint64_t seed) {
      options.seed = seed;
      return std::make_unique<GaborNoise<Dim>>(options);
    });
    // Every impulse has the same power in every bin.
    spectrum.expect_closed_form(impulses_in_tile<Dim>(noise.impulse_density()));
  });
}

TEST(GaborSpectrum, OfKernelsInAllDirectionsIsTheClosedFormPerRadialBin) {
  for_one_to_three_dimensions([]<int Dim>() {
    auto options = oriented_options(Tiles<Dim>::kPeriod, 0.0);
    options.error = 0.002;  // the closed form is that of unlimited kernels, which in the bins' tails differs
    const OrientedGaborNoise<Dim> noise(options);
    RadialMemo radial([&](double f) {
      Vec<Dim> frequency(0.0);
      frequency[0] = f;
      return noise.power_spectrum(frequency);
    });
    const auto in_band = [](const WaveNumber<Dim>& k) {
      const double f = glm::length(Vec<Dim>(k)) / Tiles<Dim>::kPeriod;
      return f < 0.45 || f > 1.7 ? -1 : static_cast<int>((f - 0.45) / 0.25);
    };
    TileSpectrum<Dim> spectrum(Tiles<Dim>::kSide, Tiles<Dim>::kPeriod);
    spectrum.set_bins(5, in_band, [&](const Vec<Dim>& f) { return radial(f); });
    add_tiles<Dim>(spectrum, [&](std::uint64_t seed) {
      options.seed = seed;
      return std::make_unique<OrientedGaborNoise<Dim>>(options);
    });
    // Whichever way its wave goes, an impulse's power per radial bin is nearly the same.
    spectrum.expect_closed_form(impulses_in_tile<Dim>(noise.impulse_density()), 2.0, 0.02);
  });
}

TEST(GaborSpectrum, OfOneDirectionIsAPairOfPeaksInClosedForm) {
  for_one_to_three_dimensions([]<int Dim>() {
    auto options = oriented_options(Tiles<Dim>::kPeriod, 1.0);
    const OrientedGaborNoise<Dim> noise(options);
    const Vec<Dim> peak = noise.kernel().frequency();
    // Bins by the distance from the nearer peak, up to where 1e-3 of the peak is left.
    const auto bin_of = [&](const WaveNumber<Dim>& k) {
      const Vec<Dim> f = Vec<Dim>(k) / Tiles<Dim>::kPeriod;
      const double distance = std::fmin(glm::length(f - peak), glm::length(f + peak));
      return distance < 0.75 ? static_cast<int>(distance / 0.25) : -1;
    };
    TileSpectrum<Dim> spectrum(Tiles<Dim>::kSide, Tiles<Dim>::kPeriod);
    spectrum.set_bins(3, bin_of, [&](const Vec<Dim>& f) { return noise.power_spectrum(f); });
    add_tiles<Dim>(spectrum, [&](std::uint64_t seed) {
      options.seed = seed;
      return std::make_unique<OrientedGaborNoise<Dim>>(options);
    });
    spectrum.expect_closed_form(impulses_in_tile<Dim>(noise.impulse_density()));
  });
}

TEST(GaborSpectrum, OfAConeOfDirectionsIsTheClosedFormPerAngle) {
  for_one_to_three_dimensions([]<int Dim>() {
    if constexpr (Dim > 1) {
      auto options = oriented_options(Tiles<Dim>::kPeriod, 0.7);
      options.error = 0.002;
      const OrientedGaborNoise<Dim> noise(options);
      // The principal band, by the cosine of the angle from the cone's axis, out to where power is left.
      const auto bin_of = [&](const WaveNumber<Dim>& k) {
        const Vec<Dim> f = Vec<Dim>(k) / Tiles<Dim>::kPeriod;
        const double length = glm::length(f);
        if (length < 0.7 || length > 1.4) return -1;
        const double cosine = std::abs(glm::dot(f, noise.directions().axis())) / length;
        if (cosine < 0.5) return -1;
        return cosine < 0.7 ? 0 : (cosine < 0.9 ? 1 : 2);
      };
      TileSpectrum<Dim> spectrum(Tiles<Dim>::kSide, Tiles<Dim>::kPeriod);
      spectrum.set_bins(3, bin_of, [&](const Vec<Dim>& f) { return noise.power_spectrum(f); });
      add_tiles<Dim>(spectrum, [&](std::uint64_t seed) {
        options.seed = seed;
        return std::make_unique<OrientedGaborNoise<Dim>>(options);
      });
      // The outer angles have power of the few impulses at the cone's edge.
      spectrum.expect_closed_form(impulses_in_tile<Dim>(noise.impulse_density()), 10.0, 0.02);
    }
  });
}

// Wedges of directions: by the longest axis, and by the signs of the others relative to the first.
template <int Dim>
int wedge(const WaveNumber<Dim>& k) {
  int longest = 0;
  for (int axis = 1; axis < Dim; ++axis) {
    if (std::abs(k[axis]) > std::abs(k[longest])) longest = axis;
  }
  int signs = 0;
  for (int axis = 1; axis < Dim; ++axis) signs = 2 * signs + (k[axis] > 0 ? 1 : 0);
  return longest * (1 << (Dim - 1)) + signs;
}

TEST(GaborSpectrum, IsotropicNoisesHaveTheSamePowerInEveryWedge) {
  for_one_to_three_dimensions([]<int Dim>() {
    if constexpr (Dim > 1) {
      constexpr int kWedges = Dim << (Dim - 1);
      const auto bin_of = [](const WaveNumber<Dim>& k) {
        const double f = glm::length(Vec<Dim>(k)) / Tiles<Dim>::kPeriod;
        for (int axis = 0; axis < Dim; ++axis) {
          if (k[axis] == 0) return -1;
        }
        return f < 0.5 || f > 1.6 ? -1 : wedge<Dim>(k);
      };
      const auto expect_isotropic = [&](auto options, auto make, double density, const auto& closed_form) {
        RadialMemo radial(closed_form);
        TileSpectrum<Dim> spectrum(Tiles<Dim>::kSide, Tiles<Dim>::kPeriod);
        spectrum.set_bins(kWedges, bin_of, [&](const Vec<Dim>& f) { return radial(f); });
        add_tiles<Dim>(spectrum, [&](std::uint64_t seed) {
          options.seed = 1000 + seed;
          return make(options);
        });
        // An impulse may have all its power in one wedge and the opposite one.
        spectrum.expect_closed_form(impulses_in_tile<Dim>(density), kWedges, 0.02);
      };
      const auto along_x = [](const Noise<Dim>& noise, double f) {
        Vec<Dim> frequency(0.0);
        frequency[0] = f;
        return noise.power_spectrum(frequency);
      };
      const auto isotropic = isotropic_options(Tiles<Dim>::kPeriod);
      const GaborNoise<Dim> noise(isotropic);
      expect_isotropic(
          isotropic, [](const auto& options) { return std::make_unique<GaborNoise<Dim>>(options); },
          noise.impulse_density(), [&](double f) { return along_x(noise, f); });
      auto oriented = oriented_options(Tiles<Dim>::kPeriod, 0.0);
      oriented.error = 0.002;
      const OrientedGaborNoise<Dim> waves(oriented);
      expect_isotropic(
          oriented, [](const auto& options) { return std::make_unique<OrientedGaborNoise<Dim>>(options); },
          waves.impulse_density(), [&](double f) { return along_x(waves, f); });
    }
  });
}

TEST(GaborSpectrum, OfAFrameIsTheClosedFormPerRadialBin) {
  constexpr double kPeriod = Tiles<3>::kPeriod;
  const auto check = [](auto options, const std::shared_ptr<const Noise<4>>& noise, double impulses,
                        auto make) {
    const auto frame = slice(noise, 0.0);
    RadialMemo radial([&](double f) { return frame->power_spectrum({f, 0.0, 0.0}); });
    const auto bin_of = [](const WaveNumber<3>& k) {
      return static_cast<int>(glm::length(Vec<3>(k)) / kPeriod / 0.3);
    };
    TileSpectrum<3> spectrum(Tiles<3>::kSide, kPeriod);
    spectrum.set_bins(5, bin_of, [&](const Vec<3>& f) { return radial(f); });
    add_tiles<3>(spectrum, [&](std::uint64_t seed) {
      options.seed = seed;
      return slice(make(options), 0.1 * static_cast<double>(seed));
    });
    // The power that an impulse has in a frame depends on its distance in time, and on its wave's speed.
    spectrum.expect_closed_form(impulses, 8.0, 0.02);
  };
  const Vec<4> period(kPeriod, kPeriod, kPeriod, 0.0);
  auto isotropic = isotropic_options(0.0);
  isotropic.period = period;
  isotropic.impulses = 60.0;
  const auto noise = std::make_shared<GaborNoise<4>>(isotropic);
  const double volume = std::pow(kPeriod, 3);
  check(isotropic, noise, noise->impulse_density() * volume * 2.0 * support_of(*noise),
        [](const auto& options) { return std::make_shared<GaborNoise<4>>(options); });
  auto oriented = oriented_options(0.0, 0.0);
  oriented.period = period;
  oriented.error = 0.005;
  oriented.impulses = 60.0;
  const auto waves = std::make_shared<OrientedGaborNoise<4>>(oriented);
  check(oriented, waves, waves->impulse_density() * volume * 2.0 * support_of(*waves),
        [](const auto& options) { return std::make_shared<OrientedGaborNoise<4>>(options); });
}

TEST(GaborSpectrum, OfAConeIntegratesToTheVariance) {
  OrientedGaborNoiseOptions options;
  options.frequency = 1.0;
  for (const double anisotropy : {0.3, 0.5, 0.9}) {
    options.anisotropy = anisotropy;
    SCOPED_TRACE(testing::Message() << "anisotropy " << anisotropy);
    // The spectrum turns around the first axis: f along it, rho from it. It is a sum of Gaussians of standard
    // deviation a / (2 sqrt(pi)) = 0.2, whose integral the trapezoidal rule at steps of 0.2 has to 1e-8.
    constexpr double kStep = 0.2;
    constexpr int kSteps = 14;
    double plane = 0.0;
    double four = 0.0;
    const OrientedGaborNoise<2> in_2d(options);
    const OrientedGaborNoise<4> in_4d(options);
    for (int i = -kSteps; i <= kSteps; ++i) {
      const double f = i * kStep;
      for (int j = -kSteps; j <= kSteps; ++j) {
        plane += kStep * kStep * in_2d.power_spectrum({f, j * kStep});
        const double rho = j * kStep;
        if (i < 0 || j < 0 || rho == 0.0) continue;
        const double mirrored = i == 0 ? 1.0 : 2.0;
        four += mirrored * kStep * kStep * 4.0 * kPi * rho * rho * in_4d.power_spectrum({f, rho, 0.0, 0.0});
      }
    }
    EXPECT_NEAR(plane, 1.0, 1e-6);
    EXPECT_NEAR(four, 1.0, 1e-6);
    const OrientedGaborNoise<3> in_3d(options);
    const double solid = 2.0 * integrate(
                                   [&](double f) {
                                     return integrate(
                                         [&](double rho) {
                                           return 2.0 * kPi * rho * in_3d.power_spectrum({f, rho, 0.0});
                                         },
                                         0.0, 3.0, 2);
                                   },
                                   0.0, 3.0, 2);
    EXPECT_NEAR(solid, 1.0, 1e-6);
  }
}

TEST(GaborSpectrum, OfCompactKernelsDiffersFromThatOfUnlimitedOnesByLittle) {
  // In one dimension, where both are at hand: the compact one for a single direction, and that of unlimited
  // Gaussians. With relative error e the difference integrates to at most 2 e (by Cauchy and Schwarz).
  for (const double error : {0.005, 0.02, 0.1}) {
    OrientedGaborNoiseOptions options;
    options.frequency = 1.0;
    options.error = error;
    const OrientedGaborNoise<1> noise(options);
    const double difference = integrate(
        [&](double f) {
          const Vec<1> frequency(f);
          return std::abs(noise.power_spectrum(frequency) -
                          noise.kernel().power_spectrum(frequency) / noise.kernel().energy());
        },
        -6.0, 6.0, 200);
    EXPECT_LT(difference, 2.0 * error);
  }
}

}  // namespace
}  // namespace solidnoise::gabor_spectrum_test
