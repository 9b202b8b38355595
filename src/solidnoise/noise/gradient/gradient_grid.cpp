#include "solidnoise/noise/gradient/gradient_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "solidnoise/noise/convolution/cell_sums.h"

namespace solidnoise {
namespace {

constexpr std::size_t kMostKnownGradients = std::size_t{1} << 22;

}  // namespace

template <int Dim>
GradientGrid<Dim>::GradientGrid(const GradientNoiseOptions& options, const std::array<CellAxis, Dim>& axes,
                                const Shape& shape)
    : axes_(axes), lattice_(options, axes) {
  const bool half = options.support == GradientNoiseOptions::Support::half;
  reach_cells_ = half ? 1 : 2;
  cell_in_radii_ = half ? 1.0f : 0.5f;
  for (int axis = 0; axis < Dim; ++axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    derivative_factor_[a] = static_cast<float>(1.0 / (reach_cells_ * axes_[a].size()));
  }

  // In units of the radius, 2, a term's s(|d|) (G . d) is t^4 (t - c2/c1) times (2 c1 G) . d.
  const double factor = 2.0 * shape.c1 * shape.amplitude;
  for (int role = 0; role < kGradientRoles; ++role) {
    const int axis = axis_of_gradient_role<Dim>(role);
    if (axis < 0) continue;
    for (std::size_t i = 0; i < kGradients; ++i) {
      gradients_[i][role] = static_cast<float>(factor * lattice_.gradients()[i][axis]);
    }
  }
  sum_.dimensions = Dim;
  sum_.spacing = cell_in_radii_;
  sum_.root = static_cast<float>(shape.c2 / shape.c1);
  sum_.gradients = gradients_;
}

template <int Dim>
KnownGradients<Dim> gradients_around(const GradientGrid<Dim>& grid, const Box<Dim>& box) {
  KnownGradients<Dim> known;
  double total = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const CellAxis& cells = grid.axis(axis);
    const std::int64_t first = cells.locate(box.lower[axis]).cell - grid.reach_cells() + 1;
    const std::int64_t last = cells.locate(box.upper[axis]).cell + grid.reach_cells();
    total *= static_cast<double>(last - first + 1);
    if (total > static_cast<double>(kMostKnownGradients)) return known;
    known.cells.first[axis] = first;
    known.cells.count[axis] = static_cast<int>(last - first + 1);
  }
  known.indices.resize(known.cells.size());
  grid.lattice().gradient_indices(known.cells, known.indices.data());
  return known;
}

template class GradientGrid<1>;
template class GradientGrid<2>;
template class GradientGrid<3>;
template class GradientGrid<4>;

template KnownGradients<1> gradients_around(const GradientGrid<1>&, const Box<1>&);
template KnownGradients<2> gradients_around(const GradientGrid<2>&, const Box<2>&);
template KnownGradients<3> gradients_around(const GradientGrid<3>&, const Box<3>&);
template KnownGradients<4> gradients_around(const GradientGrid<4>&, const Box<4>&);

namespace {

// The lattice points around the cell of a cluster, for sum_by_cell().
template <int Dim>
class PointSource {
 public:
  PointSource(const GradientGrid<Dim>& grid, Derivatives derivatives)
      : grid_(grid), derivatives_(derivatives) {
    const int rows = 2 * grid.reach_cells();
    int stride = 1;
    for (int axis = Dim - 1; axis >= 0; --axis) {
      cluster_.lattice.first[role(axis)] = static_cast<float>(1 - grid.reach_cells()) * grid.cell_in_radii();
      cluster_.lattice.rows[role(axis)] = rows;
      cluster_.lattice.stride[role(axis)] = stride;
      around_.count[axis] = rows;
      stride *= rows;
    }
    cluster_.lattice.gradient_index = indices_.data();
  }

  const std::array<CellAxis, Dim>& axes() const { return grid_.axes(); }
  std::size_t enter(std::span<const CellPoint<Dim>> group) {
    known_ = false;
    return group.size();
  }
  bool may_share(const CellPoint<Dim>& a, const CellPoint<Dim>& b) const { return a.cell == b.cell; }

  const ClusterSums& sum(std::span<const CellPoint<Dim>> points) {
    const Index<Dim> first = points.front().cell - static_cast<std::int64_t>(grid_.reach_cells() - 1);
    if (!known_ || around_.first != first) {
      around_.first = first;
      grid_.lattice().gradient_indices(around_, indices_.data());
      known_ = true;
    }
    cluster_.count = static_cast<int>(points.size());
    for (int axis = 0; axis < Dim; ++axis) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        cluster_.coordinate[role(axis)][i] =
            points[i].fraction[static_cast<std::size_t>(axis)] * grid_.cell_in_radii();
      }
    }
    sum_gradient_noise(grid_.sum(), cluster_, derivatives_, sums_);
    return sums_;
  }

  int role(int axis) const { return gradient_role<Dim>(axis); }
  float amplitude() const { return 1.0f; }
  float slope(int axis) const { return grid_.derivative_factor(axis); }

 private:
  const GradientGrid<Dim>& grid_;
  Derivatives derivatives_;
  CellBox<Dim> around_;  // the lattice points whose gradients are known
  bool known_ = false;
  std::array<std::uint8_t, 256> indices_{};  // at most 4 rows per axis, in at most 4 dimensions
  GradientCluster cluster_;
  ClusterSums sums_;
};

}  // namespace

template <int Dim>
void evaluate_gradient_noise(const GradientGrid<Dim>& grid, const Points<Dim>& points,
                             const Samples<Dim>& samples) {
  sum_by_cell(points, samples, PointSource<Dim>(grid, derivatives_of(samples)));
}

template void evaluate_gradient_noise(const GradientGrid<1>&, const Points<1>&, const Samples<1>&);
template void evaluate_gradient_noise(const GradientGrid<2>&, const Points<2>&, const Samples<2>&);
template void evaluate_gradient_noise(const GradientGrid<3>&, const Points<3>&, const Samples<3>&);
template void evaluate_gradient_noise(const GradientGrid<4>&, const Points<4>&, const Samples<4>&);

}  // namespace solidnoise
