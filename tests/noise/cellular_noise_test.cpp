#include "solidnoise/noise/cellular/cellular_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "reference/cellular_reference.h"
#include "solidnoise/core/random.h"
#include "support/each_dimension.h"
#include "support/evaluated.h"
#include "support/message_of.h"
#include "support/simd_targets.h"

namespace solidnoise::cellular_noise_test {
namespace {

using Feature = CellularNoiseOptions::Feature;

// Both features, without a period and with one that no whole number of cells fits.
template <typename Check>
void for_each_cellular_noise(const Check& check) {
  for (const Feature feature : {Feature::distance, Feature::border}) {
    for (const Vec<4>& period : {Vec<4>(0.0), Vec<4>(31.3, 8.1, 6.9, 9.4)}) {
      SCOPED_TRACE(testing::Message() << "feature " << static_cast<int>(feature) << ", period " << period[0]);
      check(CellularNoiseOptions{.frequency = 1.7, .feature = feature, .seed = 5, .period = period});
    }
  }
}

// Some hundreds of samples across 0, about `per_cell` to a cell.
template <int Dim>
Lattice<Dim> some_lattice(double frequency, double per_cell) {
  constexpr std::array<int, 4> kCount = {801, 25, 8, 4};
  Lattice<Dim> lattice;
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.origin[axis] = 0.0131 * (axis + 1);
    lattice.step[axis] = 1.0 / (frequency * (per_cell + 0.7 * axis));
    lattice.first[axis] = -7 - axis;
    lattice.count[axis] = kCount[Dim - 1] + axis;
  }
  return lattice;
}

// Positions are rounded to 2^-20 of a cell, distances to 2^-23 of their reach of two cells; a deviation is a
// seventh of a cell or more. The gradient of unit offsets turns with the offset: near a point the rounding of
// a position shows, so samples nearer than a hundredth of a cell to a jump are left out.
constexpr double kValueBound = 2e-5;
constexpr double kGradientBound = 2e-3;
constexpr double kClear = 0.01;

template <int Dim>
void expect_agreement(const CellularNoise<Dim>& noise, const Lattice<Dim>& lattice) {
  const reference::CellularProcedure<Dim> procedure(noise);
  const Evaluated<Dim> result = evaluate_in_one_block(noise, lattice);
  const double slope = std::sqrt(noise.gradient_variance()[0]);
  std::size_t clear = 0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Vec<Dim> position = sample_position(lattice, i);
    ASSERT_NEAR(result.values[i], procedure.value(position), kValueBound) << "sample " << i;
    if (procedure.clearance(position) * noise.options().frequency < kClear) continue;
    ++clear;
    const Vec<Dim> gradient = procedure.gradient(position);
    for (int axis = 0; axis < Dim; ++axis) {
      ASSERT_NEAR(result.gradient[static_cast<std::size_t>(axis)][i], gradient[axis], kGradientBound * slope)
          << "sample " << i << ", axis " << axis;
    }
  }
  EXPECT_GT(clear, lattice.size() / 2);
}

TEST(CellularNoise, AgreesWithTheReferenceForEveryInstructionSet) {
  for_each_simd_target([](std::int64_t) {
    for_each_dimension([]<int Dim>() {
      for_each_cellular_noise([](const CellularNoiseOptions& options) {
        const CellularNoise<Dim> noise(options);
        // Fine steps, and steps of more than a cell.
        for (const double per_cell : {9.3, 0.37}) {
          expect_agreement(noise, some_lattice<Dim>(options.frequency, per_cell));
        }
      });
    });
  });
}

TEST(CellularNoise, AgreesWithTheReferenceFarFromTheOrigin) {
  for_each_dimension([]<int Dim>() {
    const CellularNoise<Dim> noise({.frequency = 2.0, .feature = Feature::border});
    Lattice<Dim> lattice = some_lattice<Dim>(2.0, 8.0);
    for (int axis = 0; axis < Dim; ++axis) lattice.origin[axis] = axis % 2 == 0 ? 65536.0 : -65536.0;
    expect_agreement(noise, lattice);
  });
}

TEST(CellularNoise, IsBitIdenticalAtPointsOnLatticesAndInParts) {
  for_each_dimension([]<int Dim>() {
    for_each_cellular_noise([](const CellularNoiseOptions& options) {
      const CellularNoise<Dim> noise(options);
      const Lattice<Dim> lattice = some_lattice<Dim>(options.frequency, 5.1);
      const Evaluated<Dim> expected = evaluate_in_one_block(noise, lattice);

      std::vector<Vec<Dim>> positions;
      for (std::size_t i = 0; i < lattice.size(); ++i) positions.push_back(sample_position(lattice, i));
      Evaluated<Dim> scattered(positions.size());
      noise.evaluate(Points<Dim>{positions}, scattered.samples());
      EXPECT_EQ(scattered, expected);

      std::vector<float> alone(lattice.size());
      noise.block(lattice.bounds())->evaluate(lattice, {alone, {}});
      EXPECT_EQ(alone, expected.values) << "without a gradient";

      // A part that begins where no brick does: its samples are the last along the first axis.
      Lattice<Dim> part = lattice;
      part.first[0] += 3;
      part.count[0] -= 3;
      const Evaluated<Dim> of_part = evaluate_in_one_block(noise, part);
      const std::size_t skipped = lattice.size() - part.size();
      for (std::size_t i = 0; i < part.size(); ++i) {
        ASSERT_EQ(of_part.values[i], expected.values[skipped + i]) << "sample " << i;
      }
    });
  });
}

TEST(CellularNoise, RepeatsAfterItsPeriod) {
  for_each_dimension([]<int Dim>() {
    // Eighths of a world unit are exact, so that positions a period apart are the same place of their cells.
    const CellularNoise<Dim> noise({.frequency = 2.0, .seed = 9, .period = Vec<4>(16.0)});
    RandomStream random(3);
    std::vector<Vec<Dim>> here(500);
    for (Vec<Dim>& position : here) {
      for (int axis = 0; axis < Dim; ++axis) position[axis] = std::floor(random.next_unit() * 1024.0) / 64.0;
    }
    std::vector<float> expected(here.size());
    noise.evaluate(Points<Dim>{here}, {expected, {}});
    for (int axis = 0; axis < Dim; ++axis) {
      std::vector<Vec<Dim>> there = here;
      for (Vec<Dim>& position : there) position[axis] -= 48.0;
      std::vector<float> values(there.size());
      noise.evaluate(Points<Dim>{there}, {values, {}});
      for (std::size_t i = 0; i < there.size(); ++i) ASSERT_NEAR(values[i], expected[i], kValueBound) << i;
    }
  });
}

TEST(CellularNoise, RefusesAPeriodOfTooFewCells) {
  EXPECT_EQ(message_of<std::invalid_argument>([] {
              CellularNoise<3>({.frequency = 1.0, .period = {1.0, 0.0, 0.0, 0.0}});
            }),
            "period is 1 along x; it must be at least 3.85515 (twice the kernel's radius), or 0 for none");
}

}  // namespace
}  // namespace solidnoise::cellular_noise_test
