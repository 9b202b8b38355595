#include "solidnoise/noise/gradient/gradient_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "support/each_dimension.h"

namespace solidnoise::gradient_lattice_test {
namespace {

TEST(GradientLattice, GradientsOfEverySeedHaveMeanZeroAndIsotropicSecondMoments) {
  for_each_dimension([]<int Dim>() {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const auto gradients = make_gradients<Dim>(seed);
      for (int a = 0; a < Dim; ++a) {
        double mean = 0.0;
        for (const auto& gradient : gradients) mean += gradient[a] / kGradients;
        EXPECT_NEAR(mean, 0.0, 1e-14);
        for (int b = 0; b < Dim; ++b) {
          double moment = 0.0;
          for (const auto& gradient : gradients) moment += gradient[a] * gradient[b] / kGradients;
          EXPECT_NEAR(moment, a == b ? 1.0 / Dim : 0.0, 1e-14) << "seed " << seed;
        }
      }
    }
  });
}

TEST(GradientLattice, GradientsOfManySeedsAreUniformOnTheSphere) {
  // The fourth moment of a component is 3 / (n (n + 2)) for a uniform direction, 1 in 1D. A component's
  // fourth power is at most 1, so the mean of a seed has a standard deviation below 1/2 over the root of its
  // 32 to 128 sets of directions; 4 sigma over 400 seeds.
  constexpr int kSeeds = 400;
  for_each_dimension([]<int Dim>() {
    for (int axis = 0; axis < Dim; ++axis) {
      double moment = 0.0;
      for (int seed = 0; seed < kSeeds; ++seed) {
        for (const auto& gradient : make_gradients<Dim>(static_cast<std::uint64_t>(seed))) {
          moment += std::pow(gradient[axis], 4) / (kGradients * kSeeds);
        }
      }
      EXPECT_NEAR(moment, Dim == 1 ? 1.0 : 3.0 / (Dim * (Dim + 2.0)), 4.0 * 0.5 / std::sqrt(32.0 * kSeeds));
    }
  });
}

TEST(GradientLattice, TablesArePermutationsThatDifferByAxisAndSeed) {
  const auto tables = make_permutations<4>(3);
  for (auto table : tables) {
    std::sort(table.begin(), table.end());
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(table[i], i);
  }
  EXPECT_NE(tables[0], tables[1]);
  EXPECT_NE(tables[0], make_permutations<4>(4)[0]);
}

TEST(GradientLattice, BoxHoldsTheHashOfEveryPointBothSidesOfZeroAndAcrossThePeriod) {
  using Options = GradientNoiseOptions;
  const std::array<CellAxis, 3> axes = {CellAxis(1.0), CellAxis(0.5, 7), CellAxis(2.0, 4)};
  const CellBox<3> box{.first = Index<3>(-3, -9, -2), .count = glm::ivec3(7, 12, 9)};
  for (const auto hash : {Options::Hash::xor_tables, Options::Hash::integer}) {
    for (const auto support : {Options::Support::full, Options::Support::half}) {
      Options options;
      options.hash = hash;
      options.support = support;
      options.seed = 9;
      const GradientLattice<3> lattice(options, axes);
      const auto tables = make_permutations<3>(options.seed);
      const std::int64_t steps = support == Options::Support::half ? 2 : 1;
      std::vector<std::uint8_t> indices(box.size());
      lattice.gradient_indices(box, indices.data());
      std::size_t next = 0;
      for (std::int64_t i = -3; i < 4; ++i) {
        for (std::int64_t j = -9; j < 3; ++j) {
          for (std::int64_t k = -2; k < 7; ++k) {
            const Index<3> wrapped(i * steps, (j + 14) % 7 * steps, (k + 4) % 4 * steps);
            const std::uint64_t expected = hash == Options::Hash::integer
                                               ? hash_cell<3>(wrapped, gradient_hash_key(options.seed)) & 255u
                                               : tables[0][static_cast<std::size_t>(wrapped[0] & 255)] ^
                                                     tables[1][static_cast<std::size_t>(wrapped[1])] ^
                                                     tables[2][static_cast<std::size_t>(wrapped[2])];
            ASSERT_EQ(indices[next], expected);
            ASSERT_EQ(lattice.gradient_index(Index<3>(i, j, k)), expected);
            ++next;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace solidnoise::gradient_lattice_test
