#include "solidnoise/noise/gabor/gabor_noise.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "support/each_dimension.h"
#include "support/evaluated.h"
#include "support/gabor_noises.h"
#include "support/simd_targets.h"

namespace solidnoise::gabor_noise_test {
namespace {

// Bounds of the error against double precision, relative to the value where that is above the noise's
// standard deviation, else to the latter; derivatives count in units of 2 pi times the frequency (1 in all
// tests here). The kernel's documented RMS rounding error is 1e-3 of its own RMS in the narrowest band, where
// the worst of 1e5 samples may be 5 times that and the slope 4 times as bad; about 1e-5 at a quarter of an
// octave. From one octave on, where the polynomial has a low degree, the error is that of 20 terms of a few
// roundings of 6e-8 each; at 4 octaves kernels are steeper than the wave by far.
double bound(double bandwidth) {
  if (bandwidth >= 1.0) return bandwidth > 2.0 ? 4e-5 : 1e-5;
  return bandwidth >= 0.25 ? 1e-4 : 2e-2;
}

template <int Dim, template <int> class Noise>
std::vector<ReferenceSample<Dim>> reference_of(const Noise<Dim>& noise, const Lattice<Dim>& lattice) {
  std::vector<ReferenceSample<Dim>> reference;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    reference.push_back(reference_sample(noise, sample_position(lattice, i)));
  }
  return reference;
}

template <int Dim>
void expect_agreement(const Evaluated<Dim>& result, const std::vector<ReferenceSample<Dim>>& reference,
                      double allowed) {
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double value = reference[i].value;
    ASSERT_NEAR(result.values[i], value, allowed * std::fmax(1.0, std::abs(value))) << "sample " << i;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const double slope = reference[i].derivative[axis];
      ASSERT_NEAR(result.gradient[axis][i], slope,
                  allowed * std::fmax(2.0 * std::numbers::pi, std::abs(slope)))
          << "sample " << i << ", axis " << axis;
    }
  }
}

template <int Dim, template <int> class Noise>
void expect_agreement(const Noise<Dim>& noise, const Lattice<Dim>& lattice, double allowed) {
  expect_agreement<Dim>(evaluate_in_one_block<Dim>(noise, lattice), reference_of<Dim>(noise, lattice),
                        allowed);
}

TEST(GaborNoise, AgreesWithTheReferenceForEveryInstructionSet) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.25, 1.0, 2.0}) {
      for_each_gabor_noise<Dim>(
          [&](const auto& noise) {
            const Lattice<Dim> lattice = some_lattice<Dim>(support_of(noise));
            const auto reference = reference_of<Dim>(noise, lattice);
            for_each_simd_target([&](std::int64_t) {
              expect_agreement<Dim>(evaluate_in_one_block<Dim>(noise, lattice), reference, bound(bandwidth));
            });
          },
          bandwidth);
    }
  });
}

TEST(GaborNoise, AgreesWithTheReferenceAtTheEndsOfTheOptionsRanges) {
  for_each_dimension([]<int Dim>() {
    for (const double bandwidth : {0.05, 4.0}) {
      for (const double error : {1e-4, 0.5}) {
        const auto check = [&](const auto& noise) {
          expect_agreement<Dim>(noise, some_lattice<Dim>(support_of(noise)), bound(bandwidth));
        };
        for_each_gabor_noise<Dim>(check, bandwidth, error);
      }
    }
  });
}

TEST(GaborNoise, AgreesWithTheReferenceForTheOtherOptions) {
  for_each_dimension([]<int Dim>() {
    // As many impulses as it chooses itself; weights that are not signs; cells stretched by a period.
    GaborNoiseOptions options;
    options.frequency = 1.0;
    options.weights = ImpulseWeights::uniform;
    const GaborNoise<Dim> uniform(options);
    Lattice<Dim> lattice = some_lattice<Dim>(uniform.radius());
    lattice.count = glm::vec<Dim, int>(Dim == 4 ? 3 : 5);
    expect_agreement<Dim>(uniform, lattice, bound(1.0));

    const auto check = [&](const auto& noise) { expect_agreement<Dim>(noise, lattice, bound(1.0)); };
    for_each_gabor_noise<Dim>(check, 1.0, 0.02, Vec<4>(5.2, 0.0, 4.1, 3.4));
  });
}

// Where a component of the direction is 0, so is a factor of each wave.
TEST(GaborNoise, AgreesWithTheReferenceForDirectionsAlongEachAxisOfEitherSign) {
  for_each_dimension([]<int Dim>() {
    for (int axis = 0; axis < Dim; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        OrientedGaborNoiseOptions options;
        options.frequency = 1.0;
        options.anisotropy = 1.0;
        options.impulses = 8.0;
        options.direction = Vec<4>(0.0);
        options.direction[axis] = sign;
        const OrientedGaborNoise<Dim> noise(options);
        SCOPED_TRACE(testing::Message() << "axis " << axis << ", sign " << sign);
        expect_agreement<Dim>(noise, some_lattice<Dim>(support_of(noise)), bound(1.0));

        Vec<Dim> peak(0.0);
        peak[axis] = 1.0;
        Vec<Dim> beside(0.0);
        beside[(axis + 1) % Dim] = 1.0;
        if (Dim > 1) {
          EXPECT_GT(noise.power_spectrum(peak), 10.0 * noise.power_spectrum(beside));
        }
      }
    }
  });
}

TEST(GaborNoise, AgreesWithTheReferenceFarFromTheOriginAndAtNegativeCoordinates) {
  for_each_dimension([]<int Dim>() {
    for_each_gabor_noise<Dim>([](const auto& noise) {
      Lattice<Dim> lattice = some_lattice<Dim>(support_of(noise));
      for (int axis = 0; axis < Dim; ++axis) lattice.origin[axis] = axis % 2 == 0 ? -1e6 : 1e6;
      expect_agreement<Dim>(noise, lattice, bound(1.0));
    });
  });
}

TEST(GaborNoise, AgreesWithTheReferenceAtWholeCoordinatesAndCellCorners) {
  for_each_dimension([]<int Dim>() {
    for_each_gabor_noise<Dim>([](const auto& noise) {
      Lattice<Dim> lattice;
      lattice.first = Index<Dim>(-2);
      lattice.count = glm::vec<Dim, int>(5);
      expect_agreement<Dim>(noise, lattice, bound(1.0));
      lattice.step = Vec<Dim>(support_of(noise));  // which is the side of a cell
      expect_agreement<Dim>(noise, lattice, bound(1.0));
    });
  });
}

TEST(GaborNoise, AgreesWithTheReferenceWhereSamplesAreFarApart) {
  for_each_dimension([]<int Dim>() {
    // In cells; several samples to a block's reach, and one.
    for (const double cells : {0.51, 3.0, 13.7, 4000.0}) {
      for_each_gabor_noise<Dim>([&](const auto& noise) {
        Lattice<Dim> lattice;
        lattice.origin = Vec<Dim>(0.4);
        lattice.step = Vec<Dim>(cells * support_of(noise));
        lattice.first = Index<Dim>(-1);
        lattice.count = glm::vec<Dim, int>(Dim == 4 ? 3 : 6);
        // The rounding of t counts as often as the kernel has it as a factor; the bound is that of three.
        expect_agreement<Dim>(noise, lattice, bound(1.0) * profile(noise).taper() / 3.0);
      });
    }
  });
}

TEST(GaborNoise, TakesDifferentStepsAlongEachAxis) {
  const auto check = [](const auto& noise) {
    Lattice<3> lattice;
    lattice.step = Vec<3>(0.01, 7.0, 300.0);
    lattice.count = glm::ivec3(17, 9, 3);
    expect_agreement<3>(noise, lattice, bound(1.0));
    lattice.step = Vec<3>(300.0, 7.0, 0.01);
    lattice.count = glm::ivec3(3, 9, 17);
    expect_agreement<3>(noise, lattice, bound(1.0));
  };
  for_each_gabor_noise<3>(check);
}

}  // namespace
}  // namespace solidnoise::gabor_noise_test
