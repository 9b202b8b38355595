#include "solidnoise/noise/interpolation/axis_weights.h"

#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace solidnoise {
namespace {

// Variance of the samples' own rounding, relative to theirs: sums in single precision have a relative error
// of about 1e-6. It also keeps the equations well conditioned where samples are much alike.
constexpr double kRounding = 1e-12;

}  // namespace

AxisWeights::AxisWeights(AxisStep shape, std::span<const double> covariance) : shape_(shape) {
  const int taps = shape.taps;
  const int step = shape.step;
  const auto at = [&](int samples) { return covariance[static_cast<std::size_t>(std::abs(samples))]; };
  const auto offset = [&](int tap) { return step * (tap - (taps - 1) / 2); };  // of a tap, in samples

  Eigen::MatrixXd normal(taps, taps);
  for (int i = 0; i < taps; ++i) {
    for (int j = 0; j < taps; ++j) normal(i, j) = at(offset(i) - offset(j));
    normal(i, i) += kRounding * at(0);
  }
  const Eigen::LDLT<Eigen::MatrixXd> factors(normal);

  by_distance_.assign(static_cast<std::size_t>(step * taps / 2 + 1), 0.0);
  autocorrelation_.assign(static_cast<std::size_t>(taps), 0.0);
  for (int phase = 0; phase < step; ++phase) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(taps);
    if (phase == 0) {
      weights((taps - 1) / 2) = 1.0;
    } else {
      Eigen::VectorXd to_sample(taps);
      for (int i = 0; i < taps; ++i) to_sample(i) = at(phase - offset(i));
      weights = factors.solve(to_sample);
    }
    for (int i = 0; i < taps; ++i) {
      weights_.push_back(weights(i));
      const int distance = std::abs(phase - offset(i));
      // Phases p and step - p are mirror images: half of what lies at a distance is on either side.
      by_distance_[static_cast<std::size_t>(distance)] += weights(i) / step / (distance == 0 ? 1.0 : 2.0);
      for (int j = i; j < taps; ++j) {
        autocorrelation_[static_cast<std::size_t>(j - i)] += weights(i) * weights(j) / step;
      }
    }
  }
}

double AxisWeights::squared_error(std::span<const double> covariance) const {
  double cross = by_distance_[0] * covariance[0];
  for (std::size_t k = 1; k < by_distance_.size(); ++k) cross += 2.0 * by_distance_[k] * covariance[k];
  double square = autocorrelation_[0] * covariance[0];
  const auto step = static_cast<std::size_t>(shape_.step);
  for (std::size_t k = 1; k < autocorrelation_.size(); ++k) {
    square += 2.0 * autocorrelation_[k] * covariance[k * step];
  }
  return covariance[0] - 2.0 * cross + square;
}

AxisWeights::Response AxisWeights::response(double cosine, std::span<const double> envelope) const {
  const auto step = static_cast<std::size_t>(shape_.step);
  double before = cosine;
  double current = 1.0;
  Response response{by_distance_[0], autocorrelation_[0]};
  const std::size_t last = step * (autocorrelation_.size() - 1);
  for (std::size_t k = 1; k <= last || k < by_distance_.size(); ++k) {
    const double next = 2.0 * cosine * current - before;
    before = current;
    current = k == 1 ? cosine : next;
    const double wave = envelope.empty() ? current : current * envelope[k];
    if (k < by_distance_.size()) response.mean += 2.0 * by_distance_[k] * wave;
    if (k % step == 0 && k <= last) response.mean_square += 2.0 * autocorrelation_[k / step] * wave;
  }
  return response;
}

}  // namespace solidnoise
