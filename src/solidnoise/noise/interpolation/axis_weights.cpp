#include "solidnoise/noise/interpolation/axis_weights.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace solidnoise {
namespace {

// Variance of the samples' own rounding, relative to theirs: sums in single precision have a relative error
// of about 1e-6. It also keeps the equations well conditioned where samples are much alike.
constexpr double kRounding = 1e-12;

}  // namespace

AxisWeights::AxisWeights(AxisStep shape, const AxisCovariance& covariance, Of of) : shape_(shape) {
  const int taps = shape.taps;
  const int step = shape.step;
  const auto at = [](const std::vector<double>& values, int samples) {
    return values[static_cast<std::size_t>(std::abs(samples))];
  };
  const auto offset = [&](int tap) { return step * (tap - (taps - 1) / 2); };  // of a tap, in samples
  // Slopes change their sign with the side that a sample is on.
  const auto side = [&](int distance) { return of == Of::slopes && distance < 0 ? -1.0 : 1.0; };
  const std::vector<double>& wanted = of == Of::slopes ? covariance.value_to_slope : covariance.value;

  Eigen::MatrixXd normal(taps, taps);
  for (int i = 0; i < taps; ++i) {
    for (int j = 0; j < taps; ++j) normal(i, j) = at(covariance.value, offset(i) - offset(j));
    normal(i, i) += kRounding * covariance.value[0];
  }
  const Eigen::LDLT<Eigen::MatrixXd> factors(normal);

  by_distance_.assign(static_cast<std::size_t>(step * taps / 2 + 1), 0.0);
  autocorrelation_.assign(static_cast<std::size_t>(taps), 0.0);
  for (int phase = 0; phase < step; ++phase) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(taps);
    if (phase == 0 && of == Of::values) {
      weights((taps - 1) / 2) = 1.0;
    } else {
      Eigen::VectorXd to_sample(taps);
      for (int i = 0; i < taps; ++i) {
        const int distance = phase - offset(i);
        to_sample(i) = side(distance) * at(wanted, distance);
      }
      weights = factors.solve(to_sample);
    }
    for (int i = 0; i < taps; ++i) {
      weights_.push_back(weights(i));
      const int distance = phase - offset(i);
      // Phases p and step - p are mirror images: half of what lies at a distance is on either side.
      by_distance_[static_cast<std::size_t>(std::abs(distance))] +=
          side(distance) * weights(i) / step / (distance == 0 ? 1.0 : 2.0);
      for (int j = i; j < taps; ++j) {
        autocorrelation_[static_cast<std::size_t>(j - i)] += weights(i) * weights(j) / step;
      }
    }
  }
}

AxisWeights::Response AxisWeights::response(std::span<const double> covariance,
                                            std::span<const double> wanted) const {
  Response response{by_distance_[0] * wanted[0], autocorrelation_[0] * covariance[0]};
  for (std::size_t k = 1; k < by_distance_.size(); ++k) response.product += 2.0 * by_distance_[k] * wanted[k];
  const auto step = static_cast<std::size_t>(shape_.step);
  for (std::size_t k = 1; k < autocorrelation_.size(); ++k) {
    response.square += 2.0 * autocorrelation_[k] * covariance[k * step];
  }
  return response;
}

double AxisWeights::squared_error(std::span<const double> covariance) const {
  const Response of_values = response(covariance, covariance);
  return std::max(0.0, covariance[0] - 2.0 * of_values.product + of_values.square);
}

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
    frequency_ = std::numeric_limits<double>::quiet_NaN();
  }

  // To a wave of unit variance, of so many cycles per world unit: that of the wave before, often.
  void respond(double frequency) {
    if (frequency == frequency_) return;
    frequency_ = frequency;
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
  double frequency_ = std::numeric_limits<double>::quiet_NaN();
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
