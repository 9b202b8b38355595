#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/volume/field/layer.h"

namespace solidnoise {

// Changes values in place, each by itself.
using ValueMap = std::function<void(std::span<float>)>;

ValueMap absolute(double factor);  // factor |v|
ValueMap affine(double factor, double added);

// Piecewise linear through the stops, constant beyond them. Precondition: at least 2, increasing.
ValueMap through_ramp(const std::vector<Vec<2>>& stops);

// Mean and variance of a noise's fold, for Gaussian octaves; see Layer.
struct FoldStatistics {
  double mean = 0.0;
  double variance = 1.0;
};
FoldStatistics fold_statistics(Layer::Fold fold, const FractalOptions& fractal);

// A folded noise to its histogram: to mean 0 and variance 1, or to 0..1 by its distribution function.
ValueMap to_histogram(Layer::Histogram histogram, Layer::Fold fold, const FractalOptions& fractal);

}  // namespace solidnoise
