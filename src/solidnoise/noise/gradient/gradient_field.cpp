#include "solidnoise/noise/gradient/gradient_field.h"

#include <cstddef>
#include <cstdint>

namespace solidnoise {
namespace {

constexpr std::size_t kMostKnownGradients = std::size_t{1} << 22;

}  // namespace

template <int Dim>
GradientField<Dim>::GradientField(const GradientNoiseOptions& options, const std::array<CellAxis, Dim>& axes,
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
    const int axis = axis_of_role<Dim>(role);
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
KnownGradients<Dim> gradients_around(const GradientField<Dim>& field, const Box<Dim>& box) {
  KnownGradients<Dim> known;
  double total = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const CellAxis& cells = field.axis(axis);
    const std::int64_t first = cells.locate(box.lower[axis]).cell - field.reach_cells() + 1;
    const std::int64_t last = cells.locate(box.upper[axis]).cell + field.reach_cells();
    total *= static_cast<double>(last - first + 1);
    if (total > static_cast<double>(kMostKnownGradients)) return known;
    known.cells.first[axis] = first;
    known.cells.count[axis] = static_cast<int>(last - first + 1);
  }
  known.indices.resize(known.cells.size());
  field.lattice().gradient_indices(known.cells, known.indices.data());
  return known;
}

template class GradientField<1>;
template class GradientField<2>;
template class GradientField<3>;
template class GradientField<4>;

template KnownGradients<1> gradients_around(const GradientField<1>&, const Box<1>&);
template KnownGradients<2> gradients_around(const GradientField<2>&, const Box<2>&);
template KnownGradients<3> gradients_around(const GradientField<3>&, const Box<3>&);
template KnownGradients<4> gradients_around(const GradientField<4>&, const Box<4>&);

}  // namespace solidnoise
