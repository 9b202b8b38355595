#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "solidnoise/core/box.h"
#include "solidnoise/core/lattice.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/wave_mixture.h"

namespace solidnoise {

// Where an evaluation writes. `values` has one float per sample. `gradient` is either all empty (not wanted)
// or has, per axis, one float per sample: the analytic derivative of the value, per world unit.
template <int Dim>
struct Samples {
  std::span<float> values;
  std::array<std::span<float>, Dim> gradient{};

  bool wants_gradient() const { return !gradient[0].empty(); }
};

template <int Dim>
void fill_with_zero(const Samples<Dim>& samples) {
  std::fill(samples.values.begin(), samples.values.end(), 0.0f);
  for (const auto& derivative : samples.gradient) std::fill(derivative.begin(), derivative.end(), 0.0f);
}

// A noise made ready for one box: what is costly to make (the random impulses) is made once, and any lattice
// inside the box is then cheap. It belongs to one thread at a time, for it may keep what it has evaluated.
template <int Dim>
class NoiseBlock {
 public:
  virtual ~NoiseBlock() = default;

  // Overwrites `samples`, in the lattice's order. Precondition: the lattice lies in the block's box.
  virtual void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const = 0;
};

// A stationary random field that can be evaluated anywhere, with its statistics in closed form. Immutable;
// may be shared between threads. A sample's value depends on the noise and the sample's position only: not on
// the batch, block, thread or vector width (vector widths without fused multiply-add may differ in the last
// bits).
template <int Dim>
class Noise {
 public:
  virtual ~Noise() = default;

  virtual std::unique_ptr<NoiseBlock<Dim>> block(const Box<Dim>& box) const = 0;
  virtual void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const = 0;

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

  // The interval of frequencies (cycles per world unit) that holds all but a thousandth of the variance.
  struct Band {
    double lower = 0.0;
    double upper = 0.0;
  };
  virtual Band band() const = 0;

  // A noise that is a sum of independent ones, such as octaves, has these as its parts, in the order in which
  // they are added, each with its amplitude.
  struct Part {
    std::shared_ptr<const Noise> noise;
    double amplitude = 1.0;
  };
  virtual std::vector<Part> parts() const { return {}; }

  // The covariance as a mixture of waves, of a noise without parts; without waves if it is not stationary.
  virtual WaveMixture<Dim> waves() const { return {}; }

  // Evaluates a lattice of any size, in blocks. Serial: for several threads, make a block per task.
  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const;
};

// Covariance of the values at places `displacement` apart, world units: the inverse Fourier transform of the
// power spectrum. 0 for noises that are not stationary (gradient noise).
template <int Dim>
double covariance(const Noise<Dim>& noise, const Vec<Dim>& displacement);

extern template class Noise<1>;
extern template class Noise<2>;
extern template class Noise<3>;
extern template class Noise<4>;

}  // namespace solidnoise
