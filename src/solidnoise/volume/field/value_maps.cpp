#include "solidnoise/volume/field/value_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace solidnoise {
namespace {

// first + second erf(v / sqrt 2)
ValueMap by_error_function(float first, float second) {
  return [=](std::span<float> values) {
    constexpr float kScale = static_cast<float>(1.0 / std::numbers::sqrt2);
    for (float& v : values) v = first + second * std::erf(kScale * v);
  };
}

}  // namespace

ValueMap absolute(double factor) {
  return [scale = static_cast<float>(factor)](std::span<float> values) {
    for (float& v : values) v = scale * std::abs(v);
  };
}

ValueMap affine(double factor, double added) {
  return [scale = static_cast<float>(factor), shift = static_cast<float>(added)](std::span<float> values) {
    for (float& v : values) v = scale * v + shift;
  };
}

ValueMap through_ramp(const std::vector<Vec<2>>& stops) {
  return [stops](std::span<float> values) {
    for (float& v : values) {
      const double x = std::clamp<double>(v, stops.front().x, stops.back().x);
      const auto beyond = std::upper_bound(stops.begin() + 1, stops.end() - 1, x,
                                           [](double value, const Vec<2>& stop) { return value < stop.x; });
      const Vec<2>& from = beyond[-1];
      const double t = (x - from.x) / (beyond->x - from.x);
      v = static_cast<float>(from.y + t * (beyond->y - from.y));
    }
  };
}

FoldStatistics fold_statistics(Layer::Fold fold, const FractalOptions& fractal) {
  if (fold == Layer::Fold::none) return {};
  constexpr double kVariance = 1.0 - 2.0 / std::numbers::pi;
  const double mean = std::sqrt(2.0 / std::numbers::pi);
  if (fold == Layer::Fold::billow) return {mean, kVariance};
  double amplitudes = 0.0;
  double powers = 0.0;
  for (int k = 0; k < fractal.octaves; ++k) {
    amplitudes += std::pow(fractal.gain, k);
    powers += std::pow(fractal.gain, 2 * k);
  }
  const double sign = fold == Layer::Fold::ridged ? -1.0 : 1.0;
  return {sign * mean * amplitudes, kVariance * powers};
}

ValueMap to_histogram(Layer::Histogram histogram, Layer::Fold fold, const FractalOptions& fractal) {
  if (histogram == Layer::Histogram::uniform) {
    if (fold == Layer::Fold::none) return by_error_function(0.5f, 0.5f);
    return by_error_function(fold == Layer::Fold::ridged ? 1.0f : 0.0f, 1.0f);
  }
  const FoldStatistics statistics = fold_statistics(fold, fractal);
  const double sigma = std::sqrt(statistics.variance);
  return affine(1.0 / sigma, -statistics.mean / sigma);
}

}  // namespace solidnoise
