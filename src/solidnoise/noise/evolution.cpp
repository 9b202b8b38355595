#include "solidnoise/noise/evolution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/random.h"

namespace solidnoise {
namespace {

using std::numbers::pi;

constexpr int kLoopBits = 30;
constexpr std::uint64_t kLoopParts = std::uint64_t{1} << kLoopBits;

// Of an impulse's mark, from which the noise draws all else.
constexpr std::uint64_t kRateStream = 2;

// Normal, of standard deviation 1 (Box and Muller).
double draw_normal(RandomStream& stream) {
  const double radius = std::sqrt(-2.0 * std::log1p(-stream.next_unit()));
  const double angle = 2.0 * pi * stream.next_unit();
  return radius * std::cos(angle);
}

// Time since the start of the loop in parts of it, rounded. The remainder is exact, and the rounding forgets
// the last bits, which differ between a time and the same one a loop later.
std::uint64_t part_of_loop(double time, double loop) {
  const double parts = std::nearbyint(std::fmod(time, loop) / loop * static_cast<double>(kLoopParts));
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(parts)) % kLoopParts;
}

}  // namespace

void Evolution::validate() const {
  require_fields(*this);
  require_finite("time", time);
  if (loop > 0.0 && rate == 0.0) {
    throw std::invalid_argument(
        fmt::format("loop is {}; it must be 0, for without evolve nothing moves", loop));
  }
  if (rate * loop > kMostTurns) {
    throw std::invalid_argument(
        fmt::format("loop is {}; it must be at most {} where evolve is {}", loop, kMostTurns / rate, rate));
  }
}

double evolution_correlation(const Evolution& evolution, double lag) {
  const double s = evolution.rate;
  if (!evolution.moves()) return 1.0;
  if (evolution.loop == 0.0) return std::exp(-2.0 * std::pow(pi * s * lag, 2));
  const double per_loop = std::numbers::sqrt2 * s * evolution.loop;
  double sum = 0.0;
  double not_above = 0.0;  // probability of at most k turns
  for (int k = 1; not_above < 1.0; ++k) {
    const double next = std::erf(k / per_loop);
    sum += (next - not_above) * std::cos(2.0 * pi * k * lag / evolution.loop);
    not_above = next;
  }
  return sum;
}

double evolution_half_life(const Evolution& evolution) {
  if (!evolution.moves()) return std::numeric_limits<double>::infinity();
  if (evolution.loop == 0.0) return std::sqrt(0.5 * std::numbers::ln2) / (pi * evolution.rate);
  // Half way through the loop the correlation is negative, for P_k falls with k.
  return bisect([&](double lag) { return evolution_correlation(evolution, lag) - 0.5; }, 0.0,
                0.5 * evolution.loop);
}

Evolution evolution_of_octave(const Evolution& evolution, double frequency_ratio) {
  Evolution octave = evolution;
  octave.rate *= std::pow(frequency_ratio, 2.0 / 3.0);
  return octave;
}

ImpulseTurns::ImpulseTurns(const Evolution& evolution)
    : rate_(evolution.rate), time_(evolution.time), loops_(evolution.loop > 0.0) {
  if (!loops_) return;
  rate_ *= evolution.loop;
  loop_part_ = part_of_loop(evolution.time, evolution.loop);
}

double ImpulseTurns::at(std::uint64_t mark) const {
  RandomStream stream(derive_seed(mark, kRateStream));
  const double rate = rate_ * draw_normal(stream);
  if (!loops_) {
    const double turns = rate * time_;
    return turns - std::floor(turns);
  }
  // Away from 0, also if it is 0. Whole turns do not matter: products of integers may wrap at 2^64.
  const double whole = rate < 0.0 ? std::floor(rate) : std::max(1.0, std::ceil(rate));
  const auto turns = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)) * loop_part_;
  return static_cast<double>(turns % kLoopParts) / static_cast<double>(kLoopParts);
}

double TurningFactor::operator()(std::uint64_t mark) const {
  const double start = RandomStream(mark).next_unit();
  return std::numbers::sqrt2 * std::cos(2.0 * std::numbers::pi * (start + turns_.at(mark)));
}

}  // namespace solidnoise
