#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// One impulse of sparse white noise: where it is, and the key of its own random stream, from
// which the noise draws what else it needs (weight, phase, direction).
template <int Dim>
struct Impulse {
  std::array<std::int32_t, Dim> position;  // in 2^-20 of a cell
  std::uint64_t mark;                      // its last 24 bits are the share
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

  // The strata along the last axis, `into` farther than their cells, that may be in reach after `square` of
  // the axes before it, and maybe one more on either side.
  std::pair<std::int64_t, std::int64_t> between(float square, float into) const {
    constexpr std::size_t kLast = Dim - 1;
    constexpr double kFarthest = 1e9;  // cells
    const double radii = std::sqrt(std::max(0.0, static_cast<double>(kMost - (is_ball ? square : 0.0f))));
    const double room = scale[kLast] > 0.0f ? std::min(radii / scale[kLast], kFarthest) : kFarthest;
    const double from = std::floor(lower[kLast] - room - 1.0 - into);
    const double to = std::ceil(upper[kLast] + room - into);
    return {first[Dim - 1] + static_cast<std::int64_t>(from), first[Dim - 1] + static_cast<std::int64_t>(to)};
  }
};

// A marked point process in Dim dimensions, cell by cell: strata, which hold a fixed number of impulses each,
// or a Poisson process. Positions are independent and uniform, in the cell or in its pieces, and a cell's
// impulses are a function of its coordinates and the key alone (Lagae et al. 2009, section 4; we use an exact
// Poisson count and a hash that does not repeat).
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
      sink(Impulse<Dim>{position(draws.key_at(i, 0), draws.piece_of(i), shift), draws.mark(i)});
    }
  }

  // Calls sink(stratum, impulse) for the impulses in reach of all strata from `first` to `last`, last axis
  // fastest. Strata that are out of reach where they are shifted to are not looked into.
  template <typename Sink>
  void generate(const Index<Dim>& first, const Index<Dim>& last, const ImpulseReach<Dim>& reach,
                Sink&& sink) const {
    Row row{*this, reach};
    const auto descend = [&]<int kAxis>(const auto& self, std::uint64_t hash, float square) {
      row.shift[kAxis] = shift_by(hash);
      if constexpr (kAxis + 1 == Dim) {
        row.generate(hash, first[kAxis], last[kAxis], square, sink);
      } else {
        const float into = in_cells(row.shift[kAxis]);
        for (std::int64_t at = first[kAxis]; at <= last[kAxis]; ++at) {
          row.stratum[kAxis] = at;
          const float from = row.corner(kAxis) + into;
          const float beyond = reach.square(square, kAxis, from, from + 1.0f);
          if (beyond > ImpulseReach<Dim>::kMost) continue;
          const std::uint64_t next = hash_coordinate(hash, axes_[kAxis].wrap(at));
          self.template operator()<kAxis + 1>(self, next, beyond);
        }
      }
    };
    descend.template operator()<0>(descend, key_, 0.0f);
  }

 private:
  static float in_cells(std::int32_t quanta) {
    return static_cast<float>(quanta) / static_cast<float>(CellAxis::kQuantaPerCell);
  }

  // How far strata are shifted along an axis, by the hash of their coordinates on the axes before it.
  std::int32_t shift_by(std::uint64_t hash) const {
    return count_.is_fixed ? static_cast<std::int32_t>(hash >> (64 - CellAxis::kFractionBits)) : 0;
  }

  // `key` is that of the impulse, Draws::key_at(i, 0); its piece has so many bits of each axis as there are
  // halvings, those of the first axis lowest.
  std::array<std::int32_t, Dim> position(std::uint64_t key, std::uint32_t piece,
                                         const std::array<std::int32_t, Dim>& shift) const {
    const int bits = CellAxis::kFractionBits - count_.halvings;  // of a place in its piece
    RandomStream stream(key);
    std::array<std::int32_t, Dim> result;
    const auto place = [&](int axis, std::uint64_t uniform) {  // of 32 bits
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

  // The random numbers of the stratum with this hash: of a Poisson process the count, of pieces how they are
  // taken; then for each impulse its position, two axes to a number, and its mark.
  struct Draws {
    Draws(const ImpulseProcess& process, std::uint64_t hash)
        : key(hash), count(static_cast<int>(process.count_.mean)), in_parts(process.count_.is_fixed) {
      if (in_parts && process.count_.halvings == 0) return;
      const std::uint64_t first = RandomStream(key).next();
      key += kGoldenGamma;
      if (in_parts) {
        piece_of.draw(first, Dim * process.count_.halvings);
      } else {
        count = process.draw_count(first);
      }
    }

    // With the share in the impulse's part.
    std::uint64_t mark(int i) const {
      const std::uint64_t mark = RandomStream(key_at(i, kPairs)).next();
      if (!in_parts || count == 1) return mark;
      const std::uint64_t within = mark & kShareMask;
      const std::uint64_t share =
          ((static_cast<std::uint64_t>(i) << kShareBits) + within) / static_cast<std::uint64_t>(count);
      return mark - within + share;
    }

    // The first and the end of the impulses whose shares may be between two.
    std::pair<int, int> between(std::uint64_t least, std::uint64_t most) const {
      if (!in_parts) return {0, count};
      const auto m = static_cast<std::uint64_t>(count);
      const std::uint64_t last = ((most + 1) * m - 1) >> kShareBits;
      return {static_cast<int>((least * m) >> kShareBits), std::min(count, static_cast<int>(last) + 1)};
    }

    static constexpr int kPairs = (Dim + 1) / 2;
    std::uint64_t key_at(int i, int number) const {
      return key + static_cast<std::uint64_t>(i * (kPairs + 1) + number) * kGoldenGamma;
    }

    std::uint64_t key;
    int count;
    bool in_parts;
    PieceMap piece_of;
  };

  // Strata side by side along the last axis. What is looked at is not known in advance, and branches would be
  // mistaken half of the time: candidates are drawn first, and those that are in reach then taken out of
  // them.
  struct Row {
    const ImpulseProcess& process;
    const ImpulseReach<Dim>& reach;
    Index<Dim> stratum{0};
    std::array<std::int32_t, Dim> shift{};

    // Of the stratum's cell along an axis, from the corner of the first cell in reach.
    float corner(int axis) const { return static_cast<float>(stratum[axis] - reach.first[axis]); }

    // Of the strata from `first` to `last`, whose hash without the last axis is `hash`, and which are at
    // least this squared distance from the box along the axes before.
    template <typename Sink>
    void generate(std::uint64_t hash, std::int64_t first, std::int64_t last, float square, Sink& sink) {
      constexpr int kLast = Dim - 1;
      const auto [from, to] = reach.between(square, in_cells(shift[kLast]));
      first = std::max(first, from);
      last = std::min(last, to);
      Candidates candidates;
      for (std::int64_t at = first; at <= last; ++at) {
        const Draws draws(process, hash_coordinate(hash, process.axes_[kLast].wrap(at)));
        const auto [begin, end] = draws.between(reach.least_share, reach.most_share);
        for (int i = begin; i < end; ++i) {
          const std::uint64_t mark = draws.mark(i);
          const std::uint64_t share = mark & kShareMask;
          candidates.add(at, draws.key_at(i, 0), draws.piece_of(i), mark,
                         (share >= reach.least_share) & (share <= reach.most_share));
          if (candidates.count == Candidates::kMost) take(candidates, sink);
        }
      }
      take(candidates, sink);
    }

   private:
    struct Candidates {
      static constexpr int kMost = 64;
      int count = 0;
      std::array<std::int64_t, kMost> at;  // along the last axis
      std::array<std::uint64_t, kMost> mark;
      std::array<std::uint64_t, kMost> key;  // of its position
      std::array<std::uint32_t, kMost> piece;

      void add(std::int64_t place, std::uint64_t its_key, std::uint32_t its_piece, std::uint64_t its_mark,
               bool wanted) {
        const auto end = static_cast<std::size_t>(count);
        at[end] = place;
        mark[end] = its_mark;
        key[end] = its_key;
        piece[end] = its_piece;
        count += wanted ? 1 : 0;
      }
    };

    template <typename Sink>
    void take(Candidates& candidates, Sink& sink) {
      std::array<std::array<std::int32_t, Dim>, Candidates::kMost> positions;
      std::array<std::size_t, Candidates::kMost> taken;
      std::size_t count = 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(candidates.count); ++i) {
        positions[i] = process.position(candidates.key[i], candidates.piece[i], shift);
        stratum[Dim - 1] = candidates.at[i];
        float square = 0.0f;
        for (int axis = 0; axis < Dim; ++axis) {
          const float at = corner(axis) + in_cells(positions[i][axis]);
          square = reach.square(square, axis, at, at);
        }
        taken[count] = i;
        count += square <= ImpulseReach<Dim>::kMost ? 1 : 0;
      }
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = taken[k];
        stratum[Dim - 1] = candidates.at[i];
        sink(stratum, Impulse<Dim>{positions[i], candidates.mark[i]});
      }
      candidates.count = 0;
    }
  };

  // The Poisson count whose cumulative probability first exceeds a uniform 64-bit number.
  int draw_count(std::uint64_t uniform) const;

  std::array<CellAxis, Dim> axes_;
  ImpulseCount count_;
  std::uint64_t key_;
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
