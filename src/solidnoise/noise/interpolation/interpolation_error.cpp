#include "solidnoise/noise/interpolation/interpolation_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace solidnoise {
namespace {

// The responses of one axis' weights to waves.
class AxisResponder {
 public:
  AxisResponder(const AxisWeights& values, const AxisWeights* slopes, double step)
      : values_(values), slopes_(slopes), step_(step) {}

  // The envelope that the waves are under, and its derivative.
  void set_envelope(const std::vector<double>& envelope, const std::vector<double>& derivative) {
    envelope_ = envelope;
    derivative_ = derivative;
  }

  // To a wave of unit variance, of so many cycles per world unit.
  void respond(double frequency) {
    const auto count = static_cast<std::size_t>(values_.shape().distances());
    const double turns = 2.0 * std::numbers::pi * frequency;
    const std::complex<double> turn = std::polar(1.0, turns * step_);
    std::complex<double> phasor(1.0);
    covariance_.resize(count);
    to_slope_.resize(count);
    for (std::size_t k = 0; k < count; ++k, phasor *= turn) {
      const double envelope = envelope_.empty() ? 1.0 : envelope_[k];
      const double derivative = derivative_.empty() ? 0.0 : derivative_[k];
      covariance_[k] = envelope * phasor.real();
      to_slope_[k] = derivative * phasor.real() - envelope * turns * phasor.imag();
    }
    of_values = values_.response(covariance_, covariance_);
    if (slopes_) of_slopes = slopes_->response(covariance_, to_slope_);
  }

  AxisWeights::Response of_values;
  AxisWeights::Response of_slopes;

 private:
  const AxisWeights& values_;
  const AxisWeights* slopes_;
  double step_;
  std::vector<double> envelope_;
  std::vector<double> derivative_;
  std::vector<double> covariance_;
  std::vector<double> to_slope_;
};

// The product of what `of` an axis that is not `left_out` is.
template <int Dim, typename Of>
double product_over_axes(int left_out, const Of& of) {
  double product = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    if (axis != left_out) product *= of(static_cast<std::size_t>(axis));
  }
  return product;
}

}  // namespace

template <int Dim>
LatticeError predict_error(const WaveMixture<Dim>& waves, const Vec<Dim>& step,
                           const LatticeWeights& weights) {
  constexpr int kNone = -1;
  const bool gradient = !weights.slopes.empty();
  std::vector<AxisResponder> axes;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const AxisWeights& values = weights.values[axis];
    const double h = step[static_cast<int>(axis)];
    axes.emplace_back(values, gradient ? &weights.slopes[axis] : nullptr, h);
    if (waves.a == 0.0) continue;
    std::vector<double> envelope;
    std::vector<double> derivative;
    for (int k = 0; k < values.shape().distances(); ++k) {
      envelope.push_back(waves.envelope_correlation(k * h));
      derivative.push_back(-std::numbers::pi * waves.a * waves.a * k * h * envelope.back());
    }
    axes.back().set_envelope(envelope, derivative);
  }
  const auto respond = [&](const Vec<Dim>& frequency) {
    for (int axis = 0; axis < Dim; ++axis) axes[static_cast<std::size_t>(axis)].respond(frequency[axis]);
  };
  const auto product = [&](int left_out) {
    return product_over_axes<Dim>(left_out, [&](std::size_t axis) { return axes[axis].of_values.product; });
  };
  const auto square = [&](int left_out) {
    return product_over_axes<Dim>(left_out, [&](std::size_t axis) { return axes[axis].of_values.square; });
  };

  LatticeError error;
  for (const auto& wave : waves.waves) {
    respond(wave.frequency);
    if (!gradient) error.interpolation += wave.variance * (1.0 - 2.0 * product(kNone) + square(kNone));
    for (int axis = 0; gradient && axis < Dim; ++axis) {
      const auto& slopes = axes[static_cast<std::size_t>(axis)].of_slopes;
      error.interpolation +=
          wave.variance * (waves.slope_variance(wave, axis) - 2.0 * slopes.product * product(axis) +
                           slopes.square * square(axis));
    }
  }
  if (gradient) return error;

  for (AxisResponder& axis : axes) axis.set_envelope({}, {});
  double beyond = waves.truncation;
  for (const auto& wave : waves.truncation_waves) {
    respond(wave.frequency);
    error.truncation += wave.variance * square(kNone);
    beyond -= wave.variance;
  }
  error.truncation += std::max(0.0, beyond) * product_over_axes<Dim>(kNone, [&](std::size_t axis) {
                        return weights.values[axis].white_response();
                      });
  return error;
}

template LatticeError predict_error<2>(const WaveMixture<2>&, const Vec<2>&, const LatticeWeights&);
template LatticeError predict_error<3>(const WaveMixture<3>&, const Vec<3>&, const LatticeWeights&);

}  // namespace solidnoise
