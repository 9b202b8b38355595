#include "solidnoise/noise/convolution/impulse_process.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace solidnoise {
namespace {

// Cumulative Poisson probabilities in units of 2^-64, up to where the rest is below 2^-64.
std::vector<std::uint64_t> cumulative_poisson(double mean) {
  std::vector<std::uint64_t> cumulative;
  double sum = 0.0;
  for (int count = 0;; ++count) {
    const double probability = std::exp(count * std::log(mean) - mean - std::lgamma(count + 1.0));
    sum += probability;
    const bool past_mode = count > mean;
    if (past_mode && (probability < 0x1.0p-64 || sum >= 1.0)) break;
    cumulative.push_back(sum >= 1.0 ? std::numeric_limits<std::uint64_t>::max()
                                    : static_cast<std::uint64_t>(std::ldexp(sum, 64)));
  }
  return cumulative;
}

}  // namespace

void PieceMap::draw(std::uint64_t random, int bits) {
  // Irreducible polynomials, a bit a power, by their degree.
  constexpr std::array<std::uint32_t, 13> kModulus{0, 3, 7, 11, 19, 37, 67, 131, 283, 529, 1033, 2053, 4105};
  const std::uint32_t all = (1u << bits) - 1;
  first_ = static_cast<std::uint32_t>(random) & all;
  std::uint32_t power = 1 + static_cast<std::uint32_t>((random >> 32) * all >> 32);
  for (std::size_t bit = 0; bit < static_cast<std::size_t>(bits); ++bit) {
    times_[bit] = power;
    power <<= 1;
    if (power > all) power ^= kModulus[static_cast<std::size_t>(bits)];
  }
}

template <int Dim>
ImpulseProcess<Dim>::ImpulseProcess(const std::array<CellAxis, Dim>& axes, const ImpulseCount& count,
                                    std::uint64_t key)
    : axes_(axes), count_(count), key_(key) {
  if (count.is_fixed) {
    places_ = static_cast<int>(count.mean) / count.at_place();
    return;
  }
  cumulative_ = cumulative_poisson(count.mean);
  guide_ = static_cast<int>(count.mean);
}

template <int Dim>
int ImpulseProcess<Dim>::draw_count(std::uint64_t uniform) const {
  const int highest = static_cast<int>(cumulative_.size());
  int count = guide_ < highest ? guide_ : highest - 1;
  while (count > 0 && uniform < cumulative_[count - 1]) --count;
  while (count < highest && uniform >= cumulative_[count]) ++count;
  return count;
}

// Through strata, axis by axis. What is in reach is not known in advance, and branches would be mistaken
// half of the time: candidates are collected first, and those that are in reach then taken out of them.
template <int Dim>
struct ImpulseProcess<Dim>::Search {
  const ImpulseProcess& process;
  const Index<Dim>& first;
  const Index<Dim>& last;
  const ImpulseReach<Dim>& reach;
  const Taker& taker;
  std::array<std::int32_t, Dim> corner{};  // of strata, where they are shifted to, as positions
  static constexpr float kFarthest = 1e9f;
  float radius;  // of the support along the last axis, in cells
  CandidateBox box;
  ImpulseCandidates candidates;

  Search(const ImpulseProcess& of, const Index<Dim>& from, const Index<Dim>& to,
         const ImpulseReach<Dim>& what, const Taker& then)
      : process(of),
        first(from),
        last(to),
        reach(what),
        taker(then),
        radius(what.scale[Dim - 1] > 0.0f ? 1.0f / what.scale[Dim - 1] : kFarthest),
        box{.dimensions = Dim,
            .lower = what.lower.data(),
            .upper = what.upper.data(),
            .scale = what.scale.data(),
            .is_ball = what.is_ball,
            .most = ImpulseReach<Dim>::kMost,
            .halvings = of.count_.halvings,
            .places = of.places_,
            .mixes_keys = of.count_.is_single()} {}

  // Of strata with this hash of their coordinates on the axes before, which are at least this squared
  // distance from the box along these.
  template <int kAxis>
  void descend(std::uint64_t hash, float square) {
    const std::int32_t shift = process.shift_by(hash);
    const CellAxis& axis = process.axes_[kAxis];
    const auto corner_of = [&](std::int64_t at) {
      return static_cast<std::int32_t>((at - reach.first[kAxis]) * CellAxis::kQuantaPerCell) + shift;
    };
    if constexpr (kAxis + 1 == Dim) {
      const auto [from, to] = row_between(square, in_cells(shift));
      const std::int64_t end = std::min(last[kAxis], reach.first[kAxis] + to);
      for (std::int64_t at = std::max(first[kAxis], reach.first[kAxis] + from); at <= end;) {
        corner[kAxis] = corner_of(at);
        if (process.count_.is_single()) {
          at += add_row(hash, at, end - at + 1);
        } else {
          add(Draws(process, hash_coordinate(hash, axis.wrap(at++))));
        }
      }
    } else {
      for (std::int64_t at = first[kAxis]; at <= last[kAxis]; ++at) {
        corner[kAxis] = corner_of(at);
        const float from = in_cells(corner[kAxis]);
        const float beyond = reach.square(square, kAxis, from, from + 1.0f);
        if (beyond > ImpulseReach<Dim>::kMost) continue;
        descend<kAxis + 1>(hash_coordinate(hash, axis.wrap(at)), beyond);
      }
    }
  }

  // The strata of a row, `into` farther than their cells, that may be in reach after `square` of the axes
  // before it, and maybe one more on either side; from the first cell in reach.
  std::pair<std::int64_t, std::int64_t> row_between(float square, float into) const {
    constexpr std::size_t kLast = Dim - 1;
    const float radii = std::sqrt(std::max(0.0f, ImpulseReach<Dim>::kMost - (reach.is_ball ? square : 0.0f)));
    const float room = std::min(radii * radius, kFarthest);
    const float from = reach.lower[kLast] - room - 1.0f - into;
    const float to = reach.upper[kLast] + room - into;
    // Floor and ceiling; functions for these are slow on processors without SSE 4.1.
    return {static_cast<std::int64_t>(from) - (from < 0.0f ? 1 : 0),
            static_cast<std::int64_t>(to) + (to > 0.0f ? 1 : 0)};
  }

  // The single impulses, or pairs, of strata side by side, of as many of `wanted` as there is room for; how
  // many.
  std::int64_t add_row(std::uint64_t hash, std::int64_t at, std::int64_t wanted) {
    if (candidates.full()) take();
    const std::size_t begin = candidates.count;
    const auto each = static_cast<std::size_t>(process.count_.at_place());
    const auto room = static_cast<std::int64_t>((ImpulseCandidates::kMost - begin) / each);
    const auto strata = static_cast<std::size_t>(std::min(wanted, room));
    for (std::size_t i = 0; i < strata; ++i) {
      const auto along = static_cast<std::int64_t>(i);
      const std::uint64_t key = unmixed_hash(hash, process.axes_[Dim - 1].wrap(at + along));
      const std::int32_t position =
          corner[Dim - 1] + static_cast<std::int32_t>(along * CellAxis::kQuantaPerCell);
      for (std::size_t number = 0; number < each; ++number) {
        const std::size_t to = begin + i * each + number;
        candidates.key[to] = key;
        candidates.number[to] = static_cast<std::uint32_t>(number);
        candidates.position[Dim - 1][to] = position;
      }
    }
    for (std::size_t axis = 0; axis + 1 < Dim; ++axis) {
      std::fill_n(candidates.position[axis].begin() + begin, strata * each, corner[axis]);
    }
    candidates.count += strata * each;
    return static_cast<std::int64_t>(strata);
  }

  // Those of a stratum.
  void add(const Draws& draws) {
    const auto [begin, end] = draws.between(reach.least_share, reach.most_share);
    for (int i = begin; i < end; ++i) {
      if (candidates.full()) take();
      const std::size_t to = candidates.count++;
      const int place = draws.place_of(i);
      candidates.key[to] = draws.key_of(place);
      candidates.piece[to] = draws.piece_of(place);
      candidates.number[to] = static_cast<std::uint32_t>(i);
      for (std::size_t axis = 0; axis < Dim; ++axis) candidates.position[axis][to] = corner[axis];
    }
  }

  void take() {
    taker.take(taker.object, candidates, place_candidates(box, candidates));
    candidates.count = 0;
  }
};

template <int Dim>
void ImpulseProcess<Dim>::search(const Index<Dim>& first, const Index<Dim>& last,
                                 const ImpulseReach<Dim>& reach, const Taker& taker) const {
  Search strata(*this, first, last, reach, taker);
  strata.template descend<0>(key_, 0.0f);
  strata.take();
}

template class ImpulseProcess<1>;
template class ImpulseProcess<2>;
template class ImpulseProcess<3>;
template class ImpulseProcess<4>;

template <int Dim>
double ImpulseReach<Dim>::cells() const {
  double product = 1.0;
  for (int axis = 0; axis < Dim; ++axis) product *= static_cast<double>(last[axis] - first[axis] + 1);
  return product;
}

template struct ImpulseReach<1>;
template struct ImpulseReach<2>;
template struct ImpulseReach<3>;
template struct ImpulseReach<4>;

}  // namespace solidnoise
