#include "solidnoise/field/value_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solidnoise/field/pointwise_field.h"

namespace solidnoise {
namespace {

struct Absolute {
  float factor;

  float operator()(float v) const { return factor * std::abs(v); }
  float slope(float v) const { return v < 0.0f ? -factor : factor; }
};

struct Affine {
  float factor;
  float added;

  float operator()(float v) const { return factor * v + added; }
  float slope(float) const { return factor; }
};

// first + second erf(v / sqrt 2)
struct ErrorFunction {
  float first;
  float second;

  float operator()(float v) const {
    constexpr float kScale = static_cast<float>(1.0 / std::numbers::sqrt2);
    return first + second * std::erf(kScale * v);
  }
  float slope(float v) const {
    constexpr float kPeak = static_cast<float>(std::numbers::sqrt2 * std::numbers::inv_sqrtpi);
    return second * kPeak * std::exp(-0.5f * v * v);
  }
};

// 1/2 + asin(v) / pi of -1 to 1
struct Evenly {
  float operator()(float v) const {
    return 0.5f + static_cast<float>(std::numbers::inv_pi) * std::asin(std::clamp(v, -1.0f, 1.0f));
  }
  // Without end where waves turn.
  float slope(float v) const {
    constexpr float kLeast = 1e-6f;
    return static_cast<float>(std::numbers::inv_pi) / std::sqrt(std::max(1.0f - v * v, kLeast));
  }
};

struct Ramp {
  std::vector<Vec<2>> stops;

  float operator()(float v) const {
    const double x = std::clamp<double>(v, stops.front().x, stops.back().x);
    const Vec<2>* const beyond = stop_beyond(x);
    const Vec<2>& from = beyond[-1];
    const double t = (x - from.x) / (beyond->x - from.x);
    return static_cast<float>(from.y + t * (beyond->y - from.y));
  }
  float slope(float v) const {
    if (v < stops.front().x || v > stops.back().x) return 0.0f;
    const Vec<2>* const beyond = stop_beyond(v);
    return static_cast<float>((beyond->y - beyond[-1].y) / (beyond->x - beyond[-1].x));
  }

 private:
  const Vec<2>* stop_beyond(double x) const {
    return std::upper_bound(stops.data() + 1, stops.data() + stops.size() - 1, x,
                            [](double value, const Vec<2>& stop) { return value < stop.x; });
  }
};

FieldPtr by_error_function(FieldPtr field, float first, float second) {
  return map_field(std::move(field), ErrorFunction{first, second});
}

}  // namespace

FieldPtr absolute(FieldPtr field, double factor) {
  return map_field(std::move(field), Absolute{static_cast<float>(factor)});
}

FieldPtr affine(FieldPtr field, double factor, double added) {
  return map_field(std::move(field), Affine{static_cast<float>(factor), static_cast<float>(added)});
}

FieldPtr through_ramp(FieldPtr field, const std::vector<Vec<2>>& stops) {
  return map_field(std::move(field), Ramp{stops});
}

FoldStatistics fold_statistics(Layer::Fold fold, const FractalOptions& fractal) {
  if (fold == Layer::Fold::none || fold == Layer::Fold::crest) return {};
  constexpr double kVariance = 1.0 - 2.0 / std::numbers::pi;
  const double mean = std::sqrt(2.0 / std::numbers::pi);
  if (fold == Layer::Fold::billow) return {mean, kVariance};
  const double sign = fold == Layer::Fold::ridged ? -1.0 : 1.0;
  return {sign * mean * fractal.sum_of_ratios(), kVariance * fractal.power_of_ratios()};
}

FieldPtr to_histogram(FieldPtr folded, Layer::Histogram histogram, Layer::Fold fold,
                      const FractalOptions& fractal) {
  if (fold == Layer::Fold::crest) {
    return histogram == Layer::Histogram::uniform ? map_field(std::move(folded), Evenly{}) : folded;
  }
  if (histogram == Layer::Histogram::uniform) {
    if (fold == Layer::Fold::none) return by_error_function(std::move(folded), 0.5f, 0.5f);
    return by_error_function(std::move(folded), fold == Layer::Fold::ridged ? 1.0f : 0.0f, 1.0f);
  }
  const FoldStatistics statistics = fold_statistics(fold, fractal);
  const double sigma = std::sqrt(statistics.variance);
  return affine(std::move(folded), 1.0 / sigma, -statistics.mean / sigma);
}

}  // namespace solidnoise
