#pragma once

#include <memory>

#include "solidnoise/noise/cellular/cellular_noise_options.h"
#include "solidnoise/noise/cellular/cellular_statistics.h"
#include "solidnoise/noise/convolution/sparse_convolution.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Cellular noise (Worley 1996, "A Cellular Texture Basis Function") in Dim dimensions, 1 to 4: the distance
// to the nearest points of a Poisson process, or the difference of the two least; see CellularStatistics for
// the equations.
//
// Values have mean 0 and unit variance: low at the points (distance), or where cells meet (border). Along an
// axis with a period the process repeats after it; its density stays.
//
// Differences from the paper: distances are scaled by their closed forms; the number of points per cell has
// no upper bound, and no point is missed: cells are looked at as far as one place in 10^11 needs to have two
// points; where there are fewer, distances end. Values are single precision.
template <int Dim>
class CellularNoise final : public Noise<Dim> {
 public:
  // Throws std::invalid_argument: options.validate(), or a period of less than about four cells.
  explicit CellularNoise(const CellularNoiseOptions& options);

  const CellularNoiseOptions& options() const { return options_; }
  double radius() const { return radius_; }  // where distances end, world units

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override { return nearest_->block(box); }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    nearest_->evaluate(points, samples);
  }
  double variance() const override { return 1.0; }
  Vec<Dim> gradient_variance() const override;
  double power_spectrum(const Vec<Dim>& frequency) const override;
  double excess_kurtosis() const override { return statistics_.excess_kurtosis(); }
  Band band() const override;
  double covariance(const Vec<Dim>& displacement) const override;

  const ImpulseProcess<Dim>& points() const { return nearest_->process(); }

 private:
  CellularNoiseOptions options_;
  CellularStatistics<Dim> statistics_;
  double radius_ = 0.0;
  std::shared_ptr<const SparseConvolution<Dim>> nearest_;
};

extern template class CellularNoise<1>;
extern template class CellularNoise<2>;
extern template class CellularNoise<3>;
extern template class CellularNoise<4>;

}  // namespace solidnoise
