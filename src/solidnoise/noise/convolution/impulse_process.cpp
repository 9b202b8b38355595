#include "solidnoise/noise/convolution/impulse_process.h"

#include <cmath>
#include <limits>

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
  if (count.is_fixed) return;
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
