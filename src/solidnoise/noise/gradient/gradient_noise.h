#pragma once

#include <memory>

#include "solidnoise/noise/gradient/gradient_grid.h"
#include "solidnoise/noise/gradient/gradient_kernel.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// Kensler's wide gradient noise (Kensler, Knoll, Shirley 2008, sections 2 and 3) in Dim dimensions, 1 to 4:
// at each lattice point a unit gradient, chosen by a hash, times a radial kernel of radius 2 lattice units;
// see GradientKernel for the equation and the statistics, GradientLattice for the hash.
//
// The lattice spacing is set so that the radial power peaks at options.frequency, and values are scaled to
// unit variance on average over a lattice cell (the noise is not stationary). With a period the spacing of
// that axis is changed, by the least that makes the period a whole number of cells; the kernel is evaluated
// in lattice coordinates, so that the noise is stretched by the same factor.
//
// Differences from the paper: any number of dimensions; the gradients of each seed have mean 0 and equal
// second moments exactly (make_gradients); positions are in double precision, rounded to 2^-20 of a cell.
// Values and derivatives are single precision: within 8e-6 of the exact ones, in units of the standard
// deviation (and of 2 pi frequency for derivatives).
template <int Dim>
class GradientNoise final : public Noise<Dim> {
 public:
  // Throws std::invalid_argument: options.validate(), or a period of fewer than 4 lattice steps, or, with
  // Hash::xor_tables, of more than 256.
  explicit GradientNoise(const GradientNoiseOptions& options);

  const GradientNoiseOptions& options() const { return options_; }
  // In lattice units.
  const GradientKernel<Dim>& kernel() const { return kernel_; }
  // One lattice unit per axis, in world units.
  const Vec<Dim>& lattice_spacing() const { return spacing_; }

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override;
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override;
  double variance() const override { return 1.0; }
  Vec<Dim> gradient_variance() const override;
  double power_spectrum(const Vec<Dim>& frequency) const override;
  double excess_kurtosis() const override { return kernel_.excess_kurtosis(); }
  typename Noise<Dim>::Band band() const override;

 private:
  GradientNoiseOptions options_;
  GradientKernel<Dim> kernel_;
  Vec<Dim> spacing_;
  std::shared_ptr<const GradientGrid<Dim>> grid_;
};

extern template class GradientNoise<1>;
extern template class GradientNoise<2>;
extern template class GradientNoise<3>;
extern template class GradientNoise<4>;

}  // namespace solidnoise
