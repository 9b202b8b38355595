#pragma once

#include "solidnoise/analysis/dense_field.h"

namespace solidnoise {

// The periodic component of a field that is not periodic (Moisan 2011): what remains when the smooth field
// that carries the jumps across opposite borders is taken away, so that its Fourier transform has no cross of
// the borders' making. With v the jumps at the borders, the smooth field is
//   s^(k) = v^(k) / sum over axes of (2 cos(2 pi k_axis / n_axis) - 2),   s^(0) = 0.
// The mean stays; the variance can go either way. Every axis has one sample or more.
template <int Dim>
DenseField<Dim> periodic_component(const DenseField<Dim>& field);

extern template DenseField<2> periodic_component<2>(const DenseField<2>&);
extern template DenseField<3> periodic_component<3>(const DenseField<3>&);

}  // namespace solidnoise
