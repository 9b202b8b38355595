#include "solidnoise/noise/convolution/impulse_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/each_dimension.h"
#include "support/impulses.h"

namespace solidnoise::impulse_process_test {
namespace {

// Of every bound of 4.4 standard deviations here: one false alarm in 1e5.
constexpr double kSigmas = 4.4;

template <int Dim>
ImpulseProcess<Dim> make_process(double mean, std::uint64_t seed, std::int64_t period = 0) {
  std::array<CellAxis, Dim> axes;
  for (CellAxis& axis : axes) axis = CellAxis(1.0, period);
  return {axes, {mean, false}, derive_seed(seed, 1)};
}

// Where cubes of cells begin: across 0, and where coordinates need more bits than a float or an int have.
constexpr std::int64_t kFirstCells[] = {-5, -(std::int64_t{1} << 40), 1000000007};

TEST(ImpulseProcess, CountsArePoisson) {
  for_each_dimension([]<int Dim>() {
    for (const double mean : {0.02, 0.7, 5.3, 61.0}) {
      for (const std::int64_t first : kFirstCells) {
        const auto process = make_process<Dim>(mean, 7);
        const int cells = cells_of_cube<Dim>();
        // Cells by their count, with neighbouring counts joined until 10 cells are expected.
        std::vector<double> by_count(400, 0.0);
        for (int i = 0; i < cells; ++i) {
          by_count[impulses_of(process, cell_in_cube<Dim>(i, kSide<Dim>, first)).size()] += 1.0;
        }
        std::vector<double> found(1, 0.0);
        std::vector<double> expected(1, 0.0);
        double left = cells;
        for (std::size_t count = 0; count < by_count.size(); ++count) {
          const double k = static_cast<double>(count);
          const double probability = std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
          found.back() += by_count[count];
          expected.back() += cells * probability;
          left -= cells * probability;
          if (expected.back() >= 10.0 && left >= 10.0) {
            found.push_back(0.0);
            expected.push_back(0.0);
          }
        }
        SCOPED_TRACE(testing::Message() << "mean " << mean << ", first cell " << first);
        expect_chi_square(found, expected);
      }
    }
  });
}

TEST(ImpulseProcess, CountsOfTheRarestProcessesAreNone) {
  for (const double mean : {1e-18, 1e-30, std::numeric_limits<double>::min()}) {
    EXPECT_EQ(impulses_of(make_process<2>(mean, 1), Index<2>(3, 4)).size(), 0u);
  }
}

TEST(ImpulseProcess, PositionsAreUniformInTheCell) {
  for_each_dimension([]<int Dim>() {
    for (const std::int64_t first : kFirstCells) {
      const auto process = make_process<Dim>(4.0, 3);
      constexpr int kParts = 8;
      // Jointly for each pair of axes (in 1D of the axis with itself), at the high bits and at the next ones.
      for (int a = 0; a < Dim; ++a) {
        for (int b = std::min(a + 1, Dim - 1); b < Dim; ++b) {
          for (const int shift : {0, 3, 10}) {
            std::vector<double> found(a == b ? kParts : kParts * kParts, 0.0);
            double total = 0.0;
            for (int i = 0; i < cells_of_cube<Dim>(); ++i) {
              process.generate(cell_in_cube<Dim>(i, kSide<Dim>, first), [&](const Impulse<Dim>& impulse) {
                const auto part = [&](int axis) {
                  const std::int32_t position = impulse.position[static_cast<std::size_t>(axis)];
                  EXPECT_GE(position, 0);
                  EXPECT_LT(position, CellAxis::kQuantaPerCell);
                  return static_cast<std::size_t>((position >> (CellAxis::kFractionBits - 3 - shift)) %
                                                  kParts);
                };
                found[a == b ? part(a) : part(a) * kParts + part(b)] += 1.0;
                total += 1.0;
              });
            }
            const std::vector<double> expected(found.size(), total / static_cast<double>(found.size()));
            SCOPED_TRACE(testing::Message() << "axes " << a << ' ' << b << ", below bit " << shift);
            expect_chi_square(found, expected);
            if (a == b && Dim > 1) break;
          }
        }
      }
    }
  });
}

TEST(ImpulseProcess, BitsOfMarksAreFairAndIndependentOfPositions) {
  for_each_dimension([]<int Dim>() {
    const auto process = make_process<Dim>(4.0, 5);
    std::array<double, 64> ones{};
    std::array<double, 64> with_position{};  // agreements with the position's highest bit
    double total = 0.0;
    for (int i = 0; i < cells_of_cube<Dim>(); ++i) {
      process.generate(cell_in_cube<Dim>(i, kSide<Dim>, -5), [&](const Impulse<Dim>& impulse) {
        const bool upper_half = impulse.position[0] >= CellAxis::kQuantaPerCell / 2;
        for (std::size_t bit = 0; bit < 64; ++bit) {
          const bool one = (impulse.mark >> bit) & 1;
          ones[bit] += one ? 1.0 : 0.0;
          with_position[bit] += one == upper_half ? 1.0 : 0.0;
        }
        total += 1.0;
      });
    }
    const double bound = kSigmas * 0.5 * std::sqrt(total);
    for (std::size_t bit = 0; bit < 64; ++bit) {
      EXPECT_NEAR(ones[bit], 0.5 * total, bound) << "bit " << bit;
      EXPECT_NEAR(with_position[bit], 0.5 * total, bound) << "bit " << bit;
    }
  });
}

TEST(ImpulseProcess, NeighbouringCellsAreIndependent) {
  for_each_dimension([]<int Dim>() {
    constexpr double kMean = 3.0;
    const auto process = make_process<Dim>(kMean, 11);
    // Every neighbour on one side: the other side has the same pairs.
    int neighbours = 1;
    for (int axis = 0; axis < Dim; ++axis) neighbours *= 3;
    for (int neighbour = 0; neighbour < neighbours / 2; ++neighbour) {
      const Index<Dim> step = cell_in_cube<Dim>(neighbour, 3, -1);
      double counts = 0.0;
      double positions = 0.0;
      double signs = 0.0;
      int pairs = 0;
      const int cells = cells_of_cube<Dim>() / 4;
      for (int i = 0; i < cells; ++i) {
        const Index<Dim> cell = cell_in_cube<Dim>(i, kSide<Dim>, -7);
        const auto here = impulses_of(process, cell);
        const auto there = impulses_of(process, cell + step);
        counts += (static_cast<double>(here.size()) - kMean) * (static_cast<double>(there.size()) - kMean);
        if (here.empty() || there.empty()) continue;
        const auto centred = [](const Impulse<Dim>& impulse) {
          return static_cast<double>(impulse.position[0]) / CellAxis::kQuantaPerCell - 0.5;
        };
        positions += centred(here[0]) * centred(there[0]);
        signs += (here[0].mark ^ there[0].mark) >> 63 ? -1.0 : 1.0;
        ++pairs;
      }
      // Products of independent numbers of variance `mean`, 1/12 and 1.
      EXPECT_NEAR(counts, 0.0, kSigmas * kMean * std::sqrt(cells)) << "neighbour " << neighbour;
      EXPECT_NEAR(positions, 0.0, kSigmas / 12.0 * std::sqrt(pairs)) << "neighbour " << neighbour;
      EXPECT_NEAR(signs, 0.0, kSigmas * std::sqrt(pairs)) << "neighbour " << neighbour;
    }
  });
}

TEST(ImpulseProcess, NoCellOfAnySeedIsACopyOfAnother) {
  // Shifted copies would show as the same mark twice. Among 1e6 marks of 64 bits chance makes one such pair
  // with a probability of 3e-8.
  for_each_dimension([]<int Dim>() {
    std::set<std::uint64_t> marks;
    std::size_t count = 0;
    for (const std::uint64_t seed :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3}, std::uint64_t{1} << 32,
          std::uint64_t{1} << 63, ~std::uint64_t{0}, derive_seed(1, 1), derive_seed(1, 2)}) {
      const auto process = make_process<Dim>(1.0, seed);
      for (int i = 0; i < cells_of_cube<Dim>(); ++i) {
        process.generate(cell_in_cube<Dim>(i, kSide<Dim>, -kSide<Dim> / 2), [&](const Impulse<Dim>& impulse) {
          marks.insert(impulse.mark);
          ++count;
        });
      }
    }
    EXPECT_EQ(marks.size(), count);
  });
}

TEST(ImpulseProcess, RepeatsAfterItsPeriodOnly) {
  for_each_dimension([]<int Dim>() {
    constexpr std::int64_t kPeriod = 5;
    const auto process = make_process<Dim>(30.0, 2, kPeriod);
    const auto marks = [&](const Index<Dim>& cell) {
      std::vector<std::uint64_t> result;
      process.generate(cell, [&](const Impulse<Dim>& impulse) { result.push_back(impulse.mark); });
      return result;
    };
    for (int axis = 0; axis < Dim; ++axis) {
      const Index<Dim> cell(-2);
      for (std::int64_t step = -12; step <= 12; ++step) {
        Index<Dim> other = cell;
        other[axis] += step;
        EXPECT_EQ(marks(other) == marks(cell), step % kPeriod == 0) << "axis " << axis << ", step " << step;
      }
    }
  });
}

}  // namespace
}  // namespace solidnoise::impulse_process_test
