// Evaluation of gradient noise at scattered points.

#include "solidnoise/noise/gradient/gradient_field.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

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

namespace {

// Points that are put in order together: few enough for their memory to be reused from call to call.
constexpr std::size_t kBatch = 2048;

template <int Dim>
struct LocatedPoint {
  Index<Dim> cell;
  std::array<float, Dim> fraction;
  std::size_t index;
};

// The points from `first` on, those of one cell next to each other.
template <int Dim>
std::vector<LocatedPoint<Dim>> locate(const GradientField<Dim>& field, const Points<Dim>& points,
                                      std::size_t first, std::size_t count) {
  std::vector<LocatedPoint<Dim>> located(count);
  std::vector<std::pair<std::uint64_t, std::size_t>> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    LocatedPoint<Dim>& point = located[i];
    point.index = first + i;
    // The key need not tell all cells apart: it decides the speed, not the result.
    std::uint64_t key = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const std::size_t a = static_cast<std::size_t>(axis);
      const CellPosition position = field.axis(axis).locate(points.coordinate(point.index, axis));
      point.cell[axis] = position.cell;
      point.fraction[a] = position.fraction;
      key = key << 16 | (static_cast<std::uint64_t>(position.cell) & 0xffffu);
    }
    order[i] = {key, i};
  }
  if (std::is_sorted(order.begin(), order.end())) return located;
  std::sort(order.begin(), order.end());
  std::vector<LocatedPoint<Dim>> sorted;
  sorted.reserve(count);
  for (const auto& [key, i] : order) sorted.push_back(located[i]);
  return sorted;
}

// Moves points of one cell from the front of the rest to a cluster.
template <int Dim>
void take_cluster(const GradientField<Dim>& field, std::span<const LocatedPoint<Dim>>& rest,
                  GradientCluster& cluster) {
  const Index<Dim>& cell = rest.front().cell;
  std::size_t count = 0;
  while (count < rest.size() && count < GradientCluster::kSamples && rest[count].cell == cell) {
    for (int axis = 0; axis < Dim; ++axis) {
      cluster.position[role_of_axis<Dim>(axis)][count] =
          rest[count].fraction[static_cast<std::size_t>(axis)] * field.cell_in_radii();
    }
    ++count;
  }
  cluster.count = static_cast<int>(count);
  rest = rest.subspan(count);
}

// Writes a cluster's results to where its points are in the batch.
template <int Dim>
void store(const GradientField<Dim>& field, std::span<const LocatedPoint<Dim>> members,
           const GradientClusterResults& results, const Samples<Dim>& samples) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    samples.values[members[i].index] = results.value[i];
    if (!samples.wants_gradient()) continue;
    for (int axis = 0; axis < Dim; ++axis) {
      const std::size_t a = static_cast<std::size_t>(axis);
      samples.gradient[a][members[i].index] =
          results.derivative[role_of_axis<Dim>(axis)][i] * field.derivative_factor(axis);
    }
  }
}

}  // namespace

template <int Dim>
void evaluate_gradient_noise(const GradientField<Dim>& field, const Points<Dim>& points,
                             const Samples<Dim>& samples) {
  // The rows of lattice points around a cell.
  GradientCluster cluster;
  CellBox<Dim> cells;
  const int rows = 2 * field.reach_cells();
  int stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const int role = role_of_axis<Dim>(axis);
    cluster.lattice.first[role] = static_cast<float>(1 - field.reach_cells()) * field.cell_in_radii();
    cluster.lattice.rows[role] = rows;
    cluster.lattice.stride[role] = stride;
    cells.count[axis] = rows;
    stride *= rows;
  }
  std::array<std::uint8_t, 256> indices;  // at most 4 rows per axis, in at most 4 dimensions
  cluster.lattice.gradient_index = indices.data();

  GradientClusterResults results;
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const std::vector<LocatedPoint<Dim>> located =
        locate(field, points, first, std::min(kBatch, points.size() - first));
    std::span<const LocatedPoint<Dim>> rest = located;
    const Index<Dim>* gathered = nullptr;  // the cell whose gradients `indices` holds
    while (!rest.empty()) {
      const Index<Dim>& cell = rest.front().cell;
      if (gathered == nullptr || *gathered != cell) {
        for (int axis = 0; axis < Dim; ++axis) cells.first[axis] = cell[axis] - field.reach_cells() + 1;
        field.lattice().gradient_indices(cells, indices.data());
        gathered = &cell;
      }
      const std::span<const LocatedPoint<Dim>> before = rest;
      take_cluster(field, rest, cluster);
      sum_gradient_noise(field.sum(), cluster, output_for(samples), results);
      store<Dim>(field, before.first(static_cast<std::size_t>(cluster.count)), results, samples);
    }
  }
}

template void evaluate_gradient_noise(const GradientField<1>&, const Points<1>&, const Samples<1>&);
template void evaluate_gradient_noise(const GradientField<2>&, const Points<2>&, const Samples<2>&);
template void evaluate_gradient_noise(const GradientField<3>&, const Points<3>&, const Samples<3>&);
template void evaluate_gradient_noise(const GradientField<4>&, const Points<4>&, const Samples<4>&);

}  // namespace solidnoise
