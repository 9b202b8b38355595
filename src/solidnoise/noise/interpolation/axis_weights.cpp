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

}  // namespace solidnoise
