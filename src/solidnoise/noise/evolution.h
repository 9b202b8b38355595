#pragma once

#include <cstdint>
#include <type_traits>

#include "solidnoise/core/fields.h"

namespace solidnoise {

// The most turns per unit of time, and per loop.
inline constexpr double kMostTurns = 1e6;

// How the impulses of a noise turn as time passes, each at a rate of its own:
//   isotropic kernels:  the weight is W_i sqrt(2) cos(2 pi (a_i + rate_i t)), a_i uniform on [0, 1),
//   oriented kernels:   the phase is phase_i + 2 pi rate_i t,
//   gradients:          G_i cos(2 pi rate_i t) + H_i sin(2 pi rate_i t), H_i uniform on the circle across
//   G_i.
// At every moment all of these are distributed as at any other and independent of each other, so that
// each frame is a stationary noise with exactly the spectrum of the noise that stands still, at its cost;
// nothing moves from place to place. (A frame of a 4D noise has another spectrum: slice().)
//
// Rates are normal with mean 0. With a loop they are rounded away from 0 to a whole number of turns per loop,
// so that everything moves, and the noise repeats exactly. Times are then rounded to 2^-30 of the loop: times
// that are equal but for their rounding, such as n / 24 and n / 24 plus a loop, have the same bits.
struct Evolution {
  double rate = 0.0;  // standard deviation of the rates, turns per unit of time; 0 to 1e6; 0: stands still
  double time = 0.0;  // the moment at which the noise is looked at; any
  double loop = 0.0;  // units of time after which the noise repeats; 0: never; rate loop is at most 1e6

  bool moves() const { return rate > 0.0; }

  // Throws std::invalid_argument naming the field (`evolve` for the rate), its value and what is allowed.
  void validate() const;

  friend bool operator==(const Evolution&, const Evolution&) = default;
};

// The time is not part of a recipe: whoever makes frames says when a noise is looked at.
constexpr auto fields_of(std::type_identity<Evolution>) {
  return list_fields(field("evolve", &Evolution::rate, between(0.0, kMostTurns), "turns per unit of time",
                           "Impulses turn at rates of this standard deviation; each frame has the noise's "
                           "spectrum")
                         .without_flag(),
                     field("loop", &Evolution::loop, at_least(0.0), "units of time; 0 for none",
                           "Time after which the noise repeats")
                         .without_flag());
}

// Correlation of the noise with itself `lag` units of time later, at the same place; in space and time the
// covariance is this times the noise's own. With s the rate,
//   exp(-2 pi^2 s^2 lag^2),   and with a loop T   sum over k > 0 of P_k cos(2 pi k lag / T),
//   P_k = erf(k / (sqrt2 s T)) - erf((k - 1) / (sqrt2 s T)),
// the characteristic functions of the normal distribution and of the rounded one. Exact to 1e-12.
double evolution_correlation(const Evolution& evolution, double lag);

// The lag at which the correlation is 1/2; infinite if the noise stands still.
double evolution_half_life(const Evolution& evolution);

// The evolution of an octave whose frequency is higher by a factor: the rate grows with its power 2/3, as
// eddies of a turbulent flow turn over the faster the smaller they are (size l at a velocity that goes with
// l^(1/3): Kolmogorov 1941). Time and loop are the same.
Evolution evolution_of_octave(const Evolution& evolution, double frequency_ratio);

// How far impulses have turned at the time of an evolution.
class ImpulseTurns {
 public:
  // Precondition: evolution.moves(), valid.
  explicit ImpulseTurns(const Evolution& evolution);

  // The turns since time 0 of the impulse with this mark, up to whole ones; of a stream of random numbers
  // of their own.
  double at(std::uint64_t mark) const;

 private:
  double rate_;                  // turns per unit of time, or per loop
  double time_;                  // without a loop
  std::uint64_t loop_part_ = 0;  // the time since the loop's start in 2^-30 of it
  bool loops_;
};

// What the weights of isotropic kernels, and of kernels on surfaces, are multiplied by, sqrt(2) cos(2 pi (a +
// rate t)), by their marks; a is uniform on [0, 1).
class TurningFactor {
 public:
  // Precondition: evolution.moves(), valid.
  explicit TurningFactor(const Evolution& evolution) : turns_(evolution) {}

  double operator()(std::uint64_t mark) const;

 private:
  ImpulseTurns turns_;
};

}  // namespace solidnoise
