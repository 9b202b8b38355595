#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/convolution/impulse_block.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "support/each_dimension.h"
#include "support/impulses.h"

namespace solidnoise::strata_process_test {
namespace {

// As many impulses in every stratum.
template <int Dim>
ImpulseProcess<Dim> make_strata(int count, std::uint64_t seed, std::int64_t period = 0) {
  std::array<CellAxis, Dim> axes;
  for (CellAxis& axis : axes) axis = CellAxis(1.0, period);
  return {axes, {static_cast<double>(count), true}, derive_seed(seed, 1)};
}

// One in each piece.
template <int Dim>
ImpulseProcess<Dim> make_pieces(int halvings, std::uint64_t seed, std::int64_t period = 0) {
  std::array<CellAxis, Dim> axes;
  for (CellAxis& axis : axes) axis = CellAxis(1.0, period);
  return {axes, {std::exp2(Dim * halvings), true, halvings}, derive_seed(seed, 1)};
}

// Pairs of impulses that are each other's mirror image, in strata or in pieces of them.
template <int Dim>
ImpulseProcess<Dim> make_mirrored(int pairs, int halvings, std::uint64_t seed, std::int64_t period = 0) {
  std::array<CellAxis, Dim> axes;
  for (CellAxis& axis : axes) axis = CellAxis(1.0, period);
  const double places = halvings > 0 ? std::exp2(Dim * halvings) : pairs;
  return {axes, {2.0 * places, true, halvings, true}, derive_seed(seed, 1)};
}

TEST(Strata, HoldTheirNumberOfImpulsesInACubeThatIsShiftedByUpToACell) {
  for_each_dimension([]<int Dim>() {
    const auto process = make_strata<Dim>(3, 9);
    EXPECT_EQ(process.span(), 2);
    for (int i = 0; i < cells_of_cube<Dim>() / 10; ++i) {
      const Index<Dim> stratum = cell_in_cube<Dim>(i, kSide<Dim>, -5);
      const auto impulses = impulses_of(process, stratum);
      ASSERT_EQ(impulses.size(), 3u);
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        const auto [least, most] =
            std::minmax({impulses[0].position[axis], impulses[1].position[axis], impulses[2].position[axis]});
        ASSERT_GE(least, 0);
        ASSERT_LT(most, 2 * CellAxis::kQuantaPerCell);
        ASSERT_LT(most - least, CellAxis::kQuantaPerCell);
      }
    }
  });
}

// Over many rows (in 1D, seeds) a position is that of the shift plus one in the stratum, both uniform: modulo
// a cell it is uniform, and along a row's other axes too.
TEST(Strata, AreUniformOverAllSeedsAndRows) {
  for_each_dimension([]<int Dim>() {
    constexpr int kParts = 16;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      std::vector<double> found(kParts, 0.0);
      constexpr int kSeeds = 4000;
      for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const auto impulses = impulses_of(make_strata<Dim>(1, seed), Index<Dim>(-3));
        found[static_cast<std::size_t>(impulses[0].position[axis] % CellAxis::kQuantaPerCell * kParts /
                                       CellAxis::kQuantaPerCell)] += 1.0;
      }
      expect_chi_square(found, std::vector<double>(kParts, static_cast<double>(kSeeds) / kParts));
    }
  });
}

// Along the first axis all have one shift, along others there is one for each plane or row.
TEST(Strata, RowsAreShiftedEachByItsOwn) {
  constexpr int kCount = 4000;  // in a stratum: the least position is then the shift, to 1 in 4000
  const auto process = make_strata<2>(kCount, 4);
  const auto shift = [&](const Index<2>& stratum, std::size_t axis) {
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    for (const Impulse<2>& impulse : impulses_of(process, stratum))
      least = std::min(least, impulse.position[axis]);
    return static_cast<double>(least) / CellAxis::kQuantaPerCell;
  };
  constexpr double kNear = 0.005;  // 20 mean distances: e^-20 of false alarms each
  double across = 0.0;
  for (int row = 0; row < 20; ++row) {
    EXPECT_NEAR(shift({row, 0}, 0), shift({0, 0}, 0), kNear);
    EXPECT_NEAR(shift({row, 7}, 1), shift({row, 0}, 1), kNear);
    across += std::abs(shift({row, 0}, 1) - shift({row + 1, 0}, 1)) > 2.0 * kNear ? 1.0 : 0.0;
  }
  EXPECT_GE(across, 17.0);  // each with a probability of .98
}

TEST(Strata, RepeatAfterTheirPeriodOnly) {
  for_each_dimension([]<int Dim>() {
    constexpr std::int64_t kPeriod = 5;
    const auto process = make_strata<Dim>(2, 2, kPeriod);
    for (int axis = 0; axis < Dim; ++axis) {
      const Index<Dim> stratum(-2);
      for (std::int64_t step = -12; step <= 12; ++step) {
        Index<Dim> other = stratum;
        other[axis] += step;
        const auto here = impulses_of(process, stratum);
        const auto there = impulses_of(process, other);
        const bool same = here[0].mark == there[0].mark && here[1].position == there[1].position;
        EXPECT_EQ(same, step % kPeriod == 0) << "axis " << axis << ", step " << step;
      }
    }
  });
}

// A block has the impulses of all strata that reach it, whatever it is cut from.
TEST(Strata, ABlockHasThoseOfItsCells) {
  for_each_dimension([]<int Dim>() {
    const auto process = make_strata<Dim>(2, 6);
    const ImpulseBlock<Dim> around(process, ImpulseReach<Dim>{Index<Dim>(-3), Index<Dim>(3)});
    const ImpulseBlock<Dim> part(process, ImpulseReach<Dim>{Index<Dim>(-1), Index<Dim>(0)});
    const auto of_cell = [](const ImpulseBlock<Dim>& block, const Index<Dim>& cell) {
      std::vector<std::uint64_t> marks;
      const auto run = block.run(cell, cell[Dim - 1], cell[Dim - 1]);
      for (std::uint32_t i = run.begin; i < run.end; ++i) {
        marks.push_back(block.marks()[i]);
        for (int axis = 0; axis < Dim; ++axis) {
          EXPECT_EQ(block.position(axis)[i] / ImpulseBlock<Dim>::kQuanta,
                    cell[axis] - block.first_cell()[axis]);
        }
      }
      return marks;
    };
    std::size_t found = 0;
    for (int i = 0; i < 1 << Dim; ++i) {
      const Index<Dim> cell = cell_in_cube<Dim>(i, 2, -1);
      EXPECT_EQ(of_cell(part, cell), of_cell(around, cell));
      found += of_cell(part, cell).size();
    }
    EXPECT_EQ(found, part.size());
    EXPECT_GT(found, 0u);
  });
}

// Of all impulses those in a ball, or a box, around a box, and of them three fifths of the shares, around the
// middle: some places and some of their images; in the same order.
template <int Dim>
void expect_what_is_in_reach(const ImpulseProcess<Dim>& process, bool is_ball = true) {
  constexpr double kRadius = 1.7;
  ImpulseReach<Dim> reach{Index<Dim>(-2), Index<Dim>(3)};
  reach.lower.fill(2.3f);
  reach.upper.fill(3.1f);
  reach.scale.fill(1.0f / kRadius);
  reach.least_share = kShareMask / 5;
  reach.most_share = 4 * reach.least_share;
  reach.is_ball = is_ball;
  std::vector<std::uint64_t> found;
  std::map<std::uint64_t, Index<Dim>> places;  // by mark, from the first cell in reach
  process.generate(reach.first - Index<Dim>(1), reach.last, reach, [&](const FoundImpulse& impulse) {
    found.push_back(impulse.mark);
    for (int axis = 0; axis < Dim; ++axis) places[impulse.mark][axis] = impulse.position(axis);
  });
  std::vector<std::uint64_t> expected;
  std::size_t near_the_edge = 0;
  std::array<int, 2> of_half{};  // of the shares: of pairs the places', and the images'
  Index<Dim> stratum(-3);
  do {
    process.generate(stratum, [&](const Impulse<Dim>& impulse) {
      double square = 0.0;
      for (int axis = 0; axis < Dim; ++axis) {
        const double at = static_cast<double>(stratum[axis]) + 2.0 +
                          static_cast<double>(impulse.position[axis]) * 0x1.0p-20;
        const double along = std::pow(std::max({2.3 - at, at - 3.1, 0.0}) / kRadius, 2);
        square = is_ball ? square + along : std::max(square, along);
      }
      const std::uint64_t share = impulse.mark & kShareMask;
      if (share < reach.least_share || share > reach.most_share) return;
      of_half[share > kShareMask / 2] += square <= 1.0 ? 1 : 0;
      for (int axis = 0; axis < Dim && places.contains(impulse.mark); ++axis) {
        EXPECT_EQ(places[impulse.mark][axis],
                  (stratum[axis] - reach.first[axis]) * CellAxis::kQuantaPerCell + impulse.position[axis]);
      }
      near_the_edge += square > 1.0 && square < 1.004 ? 1 : 0;  // may be kept
      if (square <= 1.0) expected.push_back(impulse.mark);
    });
  } while (next_cell<Dim>(stratum, Index<Dim>(-3), Index<Dim>(3)));
  EXPECT_GT(of_half[0], 0);
  EXPECT_GT(of_half[1], 0);
  EXPECT_LE(found.size(), expected.size() + near_the_edge);
  EXPECT_TRUE(std::includes(
      found.begin(), found.end(), expected.begin(), expected.end(), [&](std::uint64_t a, std::uint64_t b) {
        return std::find(found.begin(), found.end(), a) < std::find(found.begin(), found.end(), b);
      }));
}

TEST(Strata, WhatIsOutOfReachIsLeftOut) {
  for_each_dimension([]<int Dim>() {
    expect_what_is_in_reach(make_strata<Dim>(1, 11));
    expect_what_is_in_reach(make_strata<Dim>(1, 11, 9));
    expect_what_is_in_reach(make_strata<Dim>(1, 11, 9), false);
    expect_what_is_in_reach(make_strata<Dim>(3, 11, 9));
    expect_what_is_in_reach(ImpulseProcess<Dim>(make_strata<Dim>(1, 11, 9).axes(), {2.5, false}, 3));
    expect_what_is_in_reach(make_pieces<Dim>(1, 11, 9));
    if (Dim < 4) expect_what_is_in_reach(make_pieces<Dim>(2, 11, 9));
    expect_what_is_in_reach(make_mirrored<Dim>(1, 0, 11));
    expect_what_is_in_reach(make_mirrored<Dim>(1, 0, 11, 9), false);
    expect_what_is_in_reach(make_mirrored<Dim>(3, 0, 11, 9));
    expect_what_is_in_reach(make_mirrored<Dim>(1, 1, 11, 9));
  });
}

// Where a stratum is, is where its pairs' middles are: in strata, one place for all, of which each impulse is
// anywhere around; in pieces one for each piece. The signs of two impulses of a pair are independent.
TEST(Strata, MirroredImpulsesLieOppositeEachOther) {
  for_each_dimension([]<int Dim>() {
    for (const int halvings : {0, 1}) {
      const int places = halvings > 0 ? 1 << Dim : 3;
      const auto process = make_mirrored<Dim>(places, halvings, 3);
      double alike = 0.0;
      std::vector<double> found(16, 0.0);  // of how far an impulse is from the middle, along an axis
      constexpr int kStrata = 2000;
      for (int number = 0; number < kStrata; ++number) {
        const auto impulses = impulses_of(process, Index<Dim>(3 * number));
        ASSERT_EQ(impulses.size(), 2u * static_cast<std::size_t>(places));
        std::set<std::array<std::int32_t, Dim>> middles;
        for (std::size_t i = 0; i < impulses.size() / 2; ++i) {
          const Impulse<Dim>& one = impulses[i];
          const Impulse<Dim>& other = impulses[i + impulses.size() / 2];
          std::array<std::int32_t, Dim> middle;
          for (std::size_t axis = 0; axis < Dim; ++axis) {
            middle[axis] = one.position[axis] + other.position[axis] + 1;
            const std::int32_t across = one.position[axis] - other.position[axis];
            ASSERT_LT(std::abs(across), CellAxis::kQuantaPerCell >> halvings);
            found[static_cast<std::size_t>(8 + (across * 8 >> (CellAxis::kFractionBits - halvings)))] += 1.0;
          }
          middles.insert(middle);
          alike += (one.mark >> 63) == (other.mark >> 63) ? 1.0 : 0.0;
        }
        ASSERT_EQ(middles.size(), halvings > 0 ? impulses.size() / 2 : 1u);
      }
      const double pairs = kStrata * places;
      EXPECT_NEAR(alike, 0.5 * pairs, 4.0 * std::sqrt(0.25 * pairs));
      expect_chi_square(found, std::vector<double>(16, pairs * Dim / 16.0));
    }
  });
}

// The impulses' pieces, in the order of their shares: along each axis their places, sorted, are of the first
// piece, the second, and so on, and those of one no farther apart than it is wide.
template <int Dim>
std::vector<std::size_t> pieces_by_share(std::vector<Impulse<Dim>> impulses, std::size_t per_axis) {
  std::sort(impulses.begin(), impulses.end(),
            [](const auto& a, const auto& b) { return (a.mark & kShareMask) < (b.mark & kShareMask); });
  std::vector<std::size_t> pieces(impulses.size(), 0);
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    std::vector<std::int32_t> places;
    for (const auto& impulse : impulses) places.push_back(impulse.position[axis]);
    std::vector<std::int32_t> sorted = places;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t in_each = sorted.size() / per_axis;
    for (std::size_t at = 0; at < sorted.size(); at += in_each) {
      EXPECT_LT(sorted[at + in_each - 1] - sorted[at],
                CellAxis::kQuantaPerCell / static_cast<std::int64_t>(per_axis));
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto rank = std::lower_bound(sorted.begin(), sorted.end(), places[i]) - sorted.begin();
      pieces[i] = pieces[i] * per_axis + static_cast<std::size_t>(rank) / in_each;
    }
  }
  return pieces;
}

// One in each, and any two parts of the shares in any two pieces alike.
template <int Dim>
void expect_any_pairs_in_any_pieces(int halvings, int strata) {
  const std::size_t per_axis = std::size_t{1} << halvings;
  const std::size_t count = std::size_t{1} << (Dim * halvings);
  const auto process = make_pieces<Dim>(halvings, 5);
  std::vector<double> pairs(count * count, 0.0);  // of the first and the last part
  for (int number = 0; number < strata; ++number) {
    const auto impulses = impulses_of(process, Index<Dim>(3 * number));
    ASSERT_EQ(impulses.size(), count);
    const std::vector<std::size_t> pieces = pieces_by_share<Dim>(impulses, per_axis);
    ASSERT_EQ(std::set<std::size_t>(pieces.begin(), pieces.end()).size(), count);
    pairs[pieces.front() * count + pieces.back()] += 1.0;
  }
  std::vector<double> found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i / count == i % count) {
      EXPECT_EQ(pairs[i], 0.0);
    } else {
      found.push_back(pairs[i]);
    }
  }
  expect_chi_square(found, std::vector<double>(found.size(), strata / static_cast<double>(found.size())));
}

TEST(Strata, PiecesHaveAnImpulseEachOfAnyPartOfTheShares) {
  for_each_dimension([]<int Dim>() { expect_any_pairs_in_any_pieces<Dim>(1, 8000); });
  expect_any_pairs_in_any_pieces<1>(2, 8000);
  expect_any_pairs_in_any_pieces<2>(2, 8000);
  expect_any_pairs_in_any_pieces<3>(2, 40000);
}

// In fields of up to 4096 elements.
TEST(Strata, EveryPieceIsTakenOnce) {
  for_each_dimension([]<int Dim>() {
    for (const int halvings : {1, 2, 3}) {
      const auto process = make_pieces<Dim>(halvings, 7);
      for (int number = 0; number < 40; ++number) {
        const std::vector<std::size_t> pieces =
            pieces_by_share<Dim>(impulses_of(process, Index<Dim>(5 * number)), std::size_t{1} << halvings);
        ASSERT_EQ(std::set<std::size_t>(pieces.begin(), pieces.end()).size(), pieces.size());
      }
    }
  });
}

TEST(Strata, EachPartOfTheSharesHasOneImpulse) {
  for (const int count : {1, 2, 3, 7, 30}) {
    const ImpulseProcess<2> process = make_strata<2>(count, 9);
    std::vector<double> within(10);  // of its part, where a share is
    constexpr int kStrata = 3000;
    for (int number = 0; number < kStrata; ++number) {
      std::vector<double> shares;
      for (const auto& impulse : impulses_of<2>(process, {number, 5}))
        shares.push_back(share_of(impulse.mark));
      std::sort(shares.begin(), shares.end());
      ASSERT_EQ(shares.size(), static_cast<std::size_t>(count));
      for (int part = 0; part < count; ++part) {
        // A step of 2^-24 may round over an edge.
        const double place = shares[static_cast<std::size_t>(part)] * count - part;
        ASSERT_GE(place, -count * 0x1.0p-24);
        ASSERT_LT(place, 1.0);
        ++within[static_cast<std::size_t>(std::max(0.0, place) * 10.0)];
      }
    }
    double chi_square = 0.0;
    const double expected = kStrata * count / 10.0;
    for (const double found : within) chi_square += std::pow(found - expected, 2) / expected;
    EXPECT_GT(regularized_gamma_q(4.5, 0.5 * chi_square), kFalseAlarm) << count;
  }
}

}  // namespace
}  // namespace solidnoise::strata_process_test
