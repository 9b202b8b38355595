#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/convolution/impulse_candidates.h"

namespace solidnoise {

// One impulse of sparse white noise: where it is, and the key of its own random stream, from
// which the noise draws what else it needs (weight, phase, direction).
template <int Dim>
struct Impulse {
  std::array<std::int32_t, Dim> position;  // in 2^-20 of a cell
  std::uint64_t mark;                      // its last 24 bits are the share
};

// One of some that were looked for.
struct FoundImpulse {
  std::uint64_t mark;
  const ImpulseCandidates& candidates;
  std::size_t index;  // among them

  std::int32_t position(int axis) const { return candidates.position[static_cast<std::size_t>(axis)][index]; }
};

// What an impulse draws first of what need not be independent of other impulses, as its weight and phase
// must: its frequency, its direction, its turn. A uniform number on [0, 1), in steps of 2^-24. Of the m
// impulses of a stratum one has a share in each m-th of [0, 1), so that a few impulses have of everything
// what many would have.
inline constexpr int kShareBits = 24;
inline constexpr std::uint64_t kShareMask = (std::uint64_t{1} << kShareBits) - 1;
inline double share_of(std::uint64_t mark) {
  return static_cast<double>(mark & kShareMask) / static_cast<double>(kShareMask + 1);
}

// How many impulses there are in a cell.
struct ImpulseCount {
  double mean = 1.0;      // > 0; whole if it is fixed
  bool is_fixed = false;  // the same in every stratum; else Poisson distributed
  // Of a fixed count: strata are cut in halves so often along each axis, 0 to 3 times, and have one impulse
  // in each of the 2^(Dim halvings) pieces. 0: anywhere in the stratum.
  int halvings = 0;
  // Of a fixed count, an even one: impulse i lies where impulse i - mean / 2 is mirrored at the centre of the
  // stratum, or of the piece, which then has both.
  bool mirrored = false;

  int at_place() const { return mirrored ? 2 : 1; }  // an impulse, or it and its mirror image
  // A stratum has one place.
  bool is_single() const { return is_fixed && mean == at_place(); }
};

// In which of a stratum's 2^bits pieces, 0 to 12 bits, each impulse lies: impulse i, whose share is in part
// i, in a i + b in the field of as many elements, a not 0 and b random, so that two impulses lie in any two
// different pieces with the same probability.
class PieceMap {
 public:
  void draw(std::uint64_t random, int bits);

  std::uint32_t operator()(int i) const {
    std::uint32_t result = first_;
    for (std::size_t bit = 0; bit < times_.size() && i >> bit != 0; ++bit) {
      if (i >> bit & 1) result ^= times_[bit];
    }
    return result;
  }

 private:
  std::uint32_t first_ = 0;                // b
  std::array<std::uint32_t, 12> times_{};  // a times x^bit
};

// Where the impulses are that reach some samples: within a kernel's support around the samples' box. Lengths
// are in cells.
template <int Dim>
struct ImpulseReach {
  Index<Dim> first{0};  // the cells in which they may be
  Index<Dim> last{0};
  std::array<float, Dim> lower{};  // the box, from the first cell's corner
  std::array<float, Dim> upper{};
  // To radii of the support, along each axis. 0: however far from the box.
  std::array<float, Dim> scale{};
  bool is_ball = true;  // else a box
  // Shares (share_of(), in 2^-24) that are of interest.
  std::uint64_t least_share = 0;
  std::uint64_t most_share = kShareMask;

  double cells() const;  // in double: may be huge

  // What is not farther than this is in reach. The margin is above what rounding may add: an impulse that is
  // kept in vain adds exactly 0.
  static constexpr float kMost = 1.002f;
  // The square of the distance, in radii, by one axis more: that the interval of an axis has from the box,
  // after `square` of the axes before it. Of a support that is a box the largest.
  float square(float square, int axis, float from, float to) const {
    const auto a = static_cast<std::size_t>(axis);
    const float distance = std::max(std::max(from - upper[a], lower[a] - to), 0.0f) * scale[a];
    return is_ball ? square + distance * distance : std::max(square, distance * distance);
  }
};

// A marked point process in Dim dimensions, cell by cell: strata, which hold a fixed number of impulses each,
// or a Poisson process. Positions are independent and uniform, in the cell or in its pieces, or in pairs of a
// place and its mirror image, and a cell's impulses are a function of its coordinates and the key alone
// (Lagae et al. 2009, section 4; we use an exact Poisson count and a hash that does not repeat).
//
// Strata are as large as cells but not where cells are: along the first axis all are shifted by one random
// number, along the second by one for each plane of strata, along the third by one for each row, and so on.
// So over the seeds the process is stationary, and in one noise no two axes show a grid.
template <int Dim>
class ImpulseProcess {
 public:
  // `key` from derive_seed.
  ImpulseProcess(const std::array<CellAxis, Dim>& axes, const ImpulseCount& count, std::uint64_t key);

  // A process of as many impulses per cell in other cells and with another key; quicker to make than anew.
  ImpulseProcess with(const std::array<CellAxis, Dim>& axes, std::uint64_t key) const {
    ImpulseProcess other = *this;
    other.axes_ = axes;
    other.key_ = key;
    return other;
  }

  const std::array<CellAxis, Dim>& axes() const { return axes_; }
  double mean_per_cell() const { return count_.mean; }
  // Cells along an axis that the impulses of a stratum may lie in: its own, and, where it is shifted, the
  // next.
  int span() const { return count_.is_fixed ? 2 : 1; }

  // Calls sink(impulse) for each impulse of a stratum, in a fixed order, at positions relative to the corner
  // of the cell of the same coordinates: 0 to span() cells. The strata of a Poisson process are its cells.
  template <typename Sink>
  void generate(const Index<Dim>& stratum, Sink&& sink) const {
    std::array<std::int32_t, Dim> shift;
    std::uint64_t hash = key_;  // as hash_cell()
    for (int axis = 0; axis < Dim; ++axis) {
      shift[axis] = shift_by(hash);
      hash = hash_coordinate(hash, axes_[axis].wrap(stratum[axis]));
    }
    const Draws draws(*this, hash);
    for (int i = 0; i < draws.count; ++i) {
      const int place = draws.place_of(i);
      sink(Impulse<Dim>{position(draws.key_of(place), draws.piece_of(place), place != i, shift),
                        mark(draws.key_of(place), static_cast<std::uint32_t>(i))});
    }
  }

  // Calls sink(FoundImpulse) for the impulses in reach of all strata from `first` to `last`, last axis
  // fastest, at positions relative to the corner of the first cell in reach. Strata that are out of reach
  // where they are shifted to are not looked into.
  template <typename Sink>
  void generate(const Index<Dim>& first, const Index<Dim>& last, const ImpulseReach<Dim>& reach,
                Sink&& sink) const {
    const auto take = [&](const ImpulseCandidates& candidates, std::uint64_t bits) {
      for (; bits != 0; bits &= bits - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(bits));
        const FoundImpulse found{mark(candidates.key[k], candidates.number[k]), candidates, k};
        const std::uint64_t share = found.mark & kShareMask;
        if (share >= reach.least_share && share <= reach.most_share) sink(found);
      }
    };
    search(first, last, reach,
           {&take, [](const void* object, const ImpulseCandidates& candidates, std::uint64_t bits) {
              (*static_cast<const decltype(take)*>(object))(candidates, bits);
            }});
  }

 private:
  static float in_cells(std::int32_t quanta) {
    return static_cast<float>(quanta) / static_cast<float>(CellAxis::kQuantaPerCell);
  }

  // How far strata are shifted along an axis, by the hash of their coordinates on the axes before it.
  std::int32_t shift_by(std::uint64_t hash) const {
    return count_.is_fixed ? static_cast<std::int32_t>(hash >> (64 - CellAxis::kFractionBits)) : 0;
  }

  // `key` is that of the place, Draws::key_of(); its piece has so many bits of each axis as there are
  // halvings, those of the first axis lowest.
  std::array<std::int32_t, Dim> position(std::uint64_t key, std::uint32_t piece, bool is_image,
                                         const std::array<std::int32_t, Dim>& shift) const {
    const int bits = CellAxis::kFractionBits - count_.halvings;  // of a place in its piece
    RandomStream stream(key);
    std::array<std::int32_t, Dim> result;
    const auto place = [&](int axis, std::uint64_t uniform) {  // of 32 bits
      if (is_image) uniform ^= 0xffffffffULL;
      const std::uint32_t corner = piece >> (axis * count_.halvings) & ((1u << count_.halvings) - 1u);
      result[axis] = shift[axis] + static_cast<std::int32_t>(uniform >> (32 - bits)) +
                     static_cast<std::int32_t>(corner << bits);
    };
    for (int axis = 0; axis < Dim; axis += 2) {
      const std::uint64_t pair = stream.next();
      place(axis, pair >> 32);
      if (axis + 1 < Dim) place(axis + 1, pair & 0xffffffffULL);
    }
    return result;
  }

  static constexpr int kPairs = (Dim + 1) / 2;  // of axes

  // What follows in the place's stream: the mark, and that of its mirror image; of a stratum's impulses with
  // the share in the part of its number.
  std::uint64_t mark(std::uint64_t key, std::uint32_t number) const {
    const int before = kPairs + (static_cast<int>(number) < places_ ? 0 : 1);
    const std::uint64_t mark = RandomStream(key + static_cast<std::uint64_t>(before) * kGoldenGamma).next();
    if (!count_.is_fixed || count_.mean == 1.0) return mark;
    const std::uint64_t within = mark & kShareMask;
    const std::uint64_t share =
        ((std::uint64_t{number} << kShareBits) + within) / static_cast<std::uint64_t>(count_.mean);
    return mark - within + share;
  }

  // The random numbers of the stratum with this hash: of a Poisson process the count, of pieces how they are
  // taken; then for each place the position, two axes to a number, and the mark, or both marks.
  struct Draws {
    Draws(const ImpulseProcess& process, std::uint64_t hash)
        : key(hash),
          count(static_cast<int>(process.count_.mean)),
          places(process.places_),
          in_parts(process.count_.is_fixed) {
      if (in_parts && process.count_.halvings == 0) return;
      const std::uint64_t first = RandomStream(key).next();
      key += kGoldenGamma;
      if (in_parts) {
        piece_of.draw(first, Dim * process.count_.halvings);
      } else {
        count = process.draw_count(first);
      }
    }

    // The first and the end of the impulses whose shares may be between two.
    std::pair<int, int> between(std::uint64_t least, std::uint64_t most) const {
      if (!in_parts) return {0, count};
      const auto m = static_cast<std::uint64_t>(count);
      const std::uint64_t last = ((most + 1) * m - 1) >> kShareBits;
      return {static_cast<int>((least * m) >> kShareBits), std::min(count, static_cast<int>(last) + 1)};
    }

    // Where impulse i is, itself or as an image.
    int place_of(int i) const { return i < places ? i : i - places; }

    // Of a place's own stream.
    std::uint64_t key_of(int place) const {
      const int marks = places < count ? 2 : 1;
      return key + static_cast<std::uint64_t>(place * (kPairs + marks)) * kGoldenGamma;
    }

    std::uint64_t key;
    int count;
    int places;
    bool in_parts;
    PieceMap piece_of;
  };

  // Takes candidates, of which some are in reach, a bit each. (A std::function allocates.)
  struct Taker {
    const void* object;
    void (*take)(const void* object, const ImpulseCandidates& candidates, std::uint64_t bits);
  };
  struct Search;
  void search(const Index<Dim>& first, const Index<Dim>& last, const ImpulseReach<Dim>& reach,
              const Taker& taker) const;

  // The Poisson count whose cumulative probability first exceeds a uniform 64-bit number.
  int draw_count(std::uint64_t uniform) const;

  std::array<CellAxis, Dim> axes_;
  ImpulseCount count_;
  std::uint64_t key_;
  // How many places are drawn for a stratum: those of impulses that are not mirror images.
  int places_ = std::numeric_limits<int>::max();
  std::vector<std::uint64_t> cumulative_;  // of counts 0, 1, ... in 2^-64
  int guide_ = 0;                          // where the search starts
};

// Moves to the next cell of a range, last axis fastest; false after the last one.
template <int Dim>
bool next_cell(Index<Dim>& cell, const Index<Dim>& first, const Index<Dim>& last) {
  for (int axis = Dim - 1; axis >= 0; --axis) {
    if (++cell[axis] <= last[axis]) return true;
    cell[axis] = first[axis];
  }
  return false;
}

}  // namespace solidnoise
