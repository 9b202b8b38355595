#include "solidnoise/analysis/exemplar/periodic_component.h"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "solidnoise/analysis/fft.h"

namespace solidnoise {

template <int Dim>
DenseField<Dim> periodic_component(const DenseField<Dim>& field) {
  const ArrayShape<Dim> shape{field.count};
  std::vector<std::complex<double>> jumps(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto position = shape.position(i);
    for (int axis = 0; axis < Dim; ++axis) {
      const int last = field.count[axis] - 1;
      if (position[axis] != 0 && position[axis] != last) continue;
      auto opposite = position;
      opposite[axis] = last - position[axis];
      jumps[i] += static_cast<double>(field.values[shape.index(opposite)]) - field.values[i];
    }
  }

  const std::vector<int> counts(&field.count[0], &field.count[0] + Dim);
  fft(jumps, counts, FftDirection::forward);
  jumps[0] = 0.0;
  for (std::size_t i = 1; i < field.size(); ++i) {
    const auto k = shape.position(i);
    double laplacian = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      laplacian += 2.0 * std::cos(2.0 * std::numbers::pi * k[axis] / field.count[axis]) - 2.0;
    }
    jumps[i] /= laplacian;
  }
  fft(jumps, counts, FftDirection::inverse);

  DenseField<Dim> result = field;
  for (std::size_t i = 0; i < field.size(); ++i) {
    result.values[i] -= static_cast<float>(jumps[i].real() / static_cast<double>(field.size()));
  }
  return result;
}

template DenseField<2> periodic_component<2>(const DenseField<2>&);
template DenseField<3> periodic_component<3>(const DenseField<3>&);

}  // namespace solidnoise
