#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solidnoise/core/check.h"
#include "solidnoise/core/field.h"
#include "solidnoise/noise/wave_mixture.h"

namespace solidnoise {

// What options of noises may be. Far beyond these, numbers overflow.
inline constexpr Interval kFrequencies = between(1e-12, 1e12);  // cycles per world unit
inline constexpr Interval kDirections = between(-1e9, 1e9);     // components
inline constexpr Interval kImpulses = between(1e-3, 1e5);  // mean, per kernel: of fewer a noise is mostly 0

// Throws std::invalid_argument for the option `impulses`, unless it is among them, or 0, which chooses.
void require_impulses(double impulses);

// A stationary random field of one channel, with its gradient, and its statistics in closed form.
template <int Dim>
class Noise : public Field<Dim> {
 public:
  bool has_gradient() const final { return true; }
  using Field<Dim>::evaluate;

  // Variance of the value at a point, over all seeds; the mean is 0. For gradient noise, which is not
  // stationary, the variance averaged over a lattice cell.
  virtual double variance() const = 0;

  // Variance of each component of the gradient, per world unit squared; the mean is 0:
  //   E[(dn/dx_i)^2] = integral of (2 pi f_i)^2 power_spectrum(f),
  // for gradient noise averaged over a lattice cell, as the variance.
  virtual Vec<Dim> gradient_variance() const = 0;

  // Two-sided power spectral density at a frequency (cycles per world unit); integrates to variance() over
  // R^Dim.
  virtual double power_spectrum(const Vec<Dim>& frequency) const = 0;

  // E[n^4] / E[n^2]^2 - 3: 0 for a Gaussian field.
  virtual double excess_kurtosis() const = 0;

  // The interval of frequencies that holds all but a thousandth of the variance.
  using Band = solidnoise::Band;
  virtual Band band() const = 0;

  std::optional<Statistics> statistics() const final {
    return Statistics{0.0, variance(), excess_kurtosis(), band()};
  }

  // A noise that is a sum of independent ones, such as octaves, has these as its parts, in the order in which
  // they are added, each with its amplitude.
  struct Part {
    std::shared_ptr<const Noise> noise;
    double amplitude = 1.0;
  };
  virtual std::vector<Part> parts() const { return {}; }

  // The covariance as a mixture of waves, of a noise without parts; without waves if it is not stationary.
  virtual WaveMixture<Dim> waves() const { return {}; }

  // Covariance of the values at places `displacement` apart, world units, of the noise without truncation:
  // the transform of power_spectrum(), which is that of the compact kernels, is within the noise's error of
  // it. 0 for noises that are not stationary (gradient noise).
  virtual double covariance(const Vec<Dim>& displacement) const;

  // Evaluates a lattice of any size, in blocks. Serial: for several threads, make a block per task.
  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const;
};

extern template class Noise<1>;
extern template class Noise<2>;
extern template class Noise<3>;
extern template class Noise<4>;

}  // namespace solidnoise
