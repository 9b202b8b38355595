#include "solidnoise/noise/gradient/gradient_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/noise/gradient/gradient_entry.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"

namespace solidnoise {

void GradientNoiseOptions::validate() const {
  require_fields(*this);
}

namespace {

constexpr int kLeastPeriod = 4;           // lattice steps: a kernel's width, so that no gradient meets itself
constexpr int kLongestTablePeriod = 256;  // entries of a permutation table

GradientNoiseOptions validated(const GradientNoiseOptions& options) {
  options.validate();
  return options;
}

// The grid along one axis: cells of `steps` lattice units of the given size, changed to fit the period.
CellAxis make_axis(const GradientNoiseOptions& options, double lattice_unit, int steps, int axis) {
  const double period = options.period[axis];
  const double size = steps * lattice_unit;
  if (period == 0.0) return CellAxis(size);
  const double cells = std::round(period / size);
  if (cells * steps < kLeastPeriod) {
    throw std::invalid_argument(fmt::format(
        "period is {} along {}; it must be at least {:.6g} ({} steps of the lattice), or 0 for none", period,
        "xyzt"[axis], kLeastPeriod * lattice_unit, kLeastPeriod));
  }
  if (cells > CellAxis::kMostCells) {
    throw std::invalid_argument(
        fmt::format("period is {} along {}; it must be at most {:.6g} (2^40 cells of the lattice)", period,
                    "xyzt"[axis], CellAxis::kMostCells * size));
  }
  if (options.hash == GradientNoiseOptions::Hash::xor_tables && cells * steps > kLongestTablePeriod) {
    throw std::invalid_argument(
        fmt::format("period is {} along {}; with hash xor-tables it must be at most {:.6g} ({} steps of the "
                    "lattice): use "
                    "hash integer, or a lower frequency",
                    period, "xyzt"[axis], kLongestTablePeriod * lattice_unit, kLongestTablePeriod));
  }
  return CellAxis(period / cells, static_cast<std::int64_t>(cells));
}

template <int Dim>
class GradientBlock final : public FieldBlock<Dim> {
 public:
  GradientBlock(std::shared_ptr<const GradientGrid<Dim>> grid, const Box<Dim>& box)
      : grid_(std::move(grid)), known_(gradients_around(*grid_, box)) {}

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    evaluate_gradient_noise(*grid_, known_, lattice, samples);
  }

 private:
  std::shared_ptr<const GradientGrid<Dim>> grid_;
  KnownGradients<Dim> known_;
};

}  // namespace

template <int Dim>
GradientNoise<Dim>::GradientNoise(const GradientNoiseOptions& options)
    : options_(validated(options)), kernel_(options.kernel, options.support) {
  const int steps = options.support == GradientNoiseOptions::Support::half ? 2 : 1;
  const double lattice_unit = kernel_.radial_peak() / options.frequency;
  std::array<CellAxis, Dim> axes;
  for (int axis = 0; axis < Dim; ++axis) {
    CellAxis& made = axes[static_cast<std::size_t>(axis)];
    made = make_axis(options, lattice_unit, steps, axis);
    spacing_[axis] = made.size() / steps;
  }
  const typename GradientGrid<Dim>::Shape shape{
      .c1 = kernel_.c1(), .c2 = kernel_.c2(), .amplitude = 1.0 / std::sqrt(kernel_.mean_variance())};
  grid_ = std::make_shared<const GradientGrid<Dim>>(options_, axes, shape);
}

template <int Dim>
std::unique_ptr<FieldBlock<Dim>> GradientNoise<Dim>::block(const Box<Dim>& box) const {
  return std::make_unique<GradientBlock<Dim>>(grid_, box);
}

template <int Dim>
void GradientNoise<Dim>::evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const {
  evaluate_gradient_noise(*grid_, points, samples);
}

template <int Dim>
Vec<Dim> GradientNoise<Dim>::gradient_variance() const {
  return variance() * kernel_.mean_gradient_variance() / kernel_.mean_variance() / (spacing_ * spacing_);
}

template <int Dim>
double GradientNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  double squared = 0.0;
  double cell_volume = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const double cycles_per_step = frequency[axis] * spacing_[axis];
    squared += cycles_per_step * cycles_per_step;
    cell_volume *= spacing_[axis];
  }
  return kernel_.power_spectrum(std::sqrt(squared)) * cell_volume / kernel_.mean_variance();
}

template <int Dim>
typename Noise<Dim>::Band GradientNoise<Dim>::band() const {
  double narrowest = spacing_[0];
  double widest = spacing_[0];
  for (int axis = 1; axis < Dim; ++axis) {
    narrowest = std::min(narrowest, spacing_[axis]);
    widest = std::max(widest, spacing_[axis]);
  }
  const typename Noise<Dim>::Band steps = kernel_.band();
  return {steps.lower / widest, steps.upper / narrowest};
}

template class GradientNoise<1>;
template class GradientNoise<2>;
template class GradientNoise<3>;
template class GradientNoise<4>;

}  // namespace solidnoise
