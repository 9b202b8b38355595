#pragma once

#include <vector>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/field/layer.h"

namespace solidnoise {

// Fields whose values are those of another, changed one by one.

FieldPtr absolute(FieldPtr field, double factor);  // factor |v|
FieldPtr affine(FieldPtr field, double factor, double added);

// Piecewise linear through the stops, constant beyond them. Precondition: at least 2, increasing.
FieldPtr through_ramp(FieldPtr field, const std::vector<Vec<2>>& stops);

// Mean and variance of a noise's fold, for Gaussian octaves; see Layer.
struct FoldStatistics {
  double mean = 0.0;
  double variance = 1.0;
};
FoldStatistics fold_statistics(Layer::Fold fold, const FractalOptions& fractal);

// A folded noise to its histogram: to mean 0 and variance 1, or to 0..1 by its distribution function.
FieldPtr to_histogram(FieldPtr folded, Layer::Histogram histogram, Layer::Fold fold,
                      const FractalOptions& fractal);

}  // namespace solidnoise
