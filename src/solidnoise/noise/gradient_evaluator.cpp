#include "solidnoise/noise/gradient_evaluator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace solidnoise {
namespace {

constexpr std::size_t kMostKnownGradients = std::size_t{1} << 22;
constexpr std::size_t kPointBatch = 1 << 14;

// How a tile's lanes are shared between the mid and the fast role, and the most samples of a tile per role.
template <int Dim>
constexpr int kFastLanes = Dim >= 3 ? 4 : GradientTile::kLanes;
template <int Dim>
constexpr int kMidLanes = GradientTile::kLanes / kFastLanes<Dim>;
constexpr int kMostSamplesPerAxis = 2 * GradientTile::kLanes;

template <int Dim>
constexpr int samples_per_group(int role) {
  if (role == kFast) return kFastLanes<Dim>;
  if (role == kMid) return kMidLanes<Dim>;
  return role == kSlow ? GradientTile::kSlow : 1;
}

// Most samples of a tile along a role: two groups, and one sample of time.
template <int Dim>
constexpr int samples_per_tile(int role) {
  return role == kOuter ? 1 : 2 * samples_per_group<Dim>(role);
}

}  // namespace

// Samples of one axis of a tile: positions in radii from the lower corner of cell `base`, and the cells of
// the first and last.
template <int Dim>
struct GradientEvaluator<Dim>::LocatedAxis {
  int count = 0;
  std::int64_t base = 0;
  int rows = 0;  // of lattice points that may reach them, from base - reach + 1
  std::array<float, kMostSamplesPerAxis> position;
};

template <int Dim>
struct GradientEvaluator<Dim>::LocatedPoint {
  Index<Dim> cell;
  std::array<float, Dim> fraction;
  std::size_t index;
};

// A tile's samples: per axis, where it begins in the lattice, and its located samples.
template <int Dim>
struct GradientEvaluator<Dim>::TileSpan {
  std::array<int, Dim> first{};
  std::array<LocatedAxis, Dim> axes;
};

template <int Dim>
GradientEvaluator<Dim>::GradientEvaluator(const GradientNoiseOptions& options,
                                          const std::array<CellAxis, Dim>& axes, const Shape& shape)
    : axes_(axes), lattice_(options, axes) {
  const bool half = options.support == GradientNoiseOptions::Support::half;
  reach_cells_ = half ? 1 : 2;
  cell_in_radii_ = half ? 1.0f : 0.5f;
  for (int axis = 0; axis < Dim; ++axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    per_radius_[a] = static_cast<float>(1.0 / (reach_cells_ * axes_[a].size()));
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
}

template <int Dim>
KnownGradients<Dim> GradientEvaluator<Dim>::gradients_around(const Box<Dim>& box) const {
  KnownGradients<Dim> known;
  double total = 1.0;
  for (int axis = 0; axis < Dim; ++axis) {
    const CellAxis& cells = axes_[static_cast<std::size_t>(axis)];
    const std::int64_t first = cells.locate(box.lower[axis]).cell - reach_cells_ + 1;
    const std::int64_t last = cells.locate(box.upper[axis]).cell + reach_cells_;
    total *= static_cast<double>(last - first + 1);
    if (total > static_cast<double>(kMostKnownGradients)) return known;
    known.cells.first[axis] = first;
    known.cells.count[axis] = static_cast<int>(last - first + 1);
  }
  known.indices.resize(known.cells.size());
  lattice_.gradient_indices(known.cells, known.indices.data());
  return known;
}

template <int Dim>
typename GradientEvaluator<Dim>::LocatedAxis GradientEvaluator<Dim>::locate(const Lattice<Dim>& lattice,
                                                                            int axis, int first,
                                                                            int count) const {
  const CellAxis& cells = axes_[static_cast<std::size_t>(axis)];
  LocatedAxis located;
  CellPosition last = cells.locate(lattice.coordinate(axis, first));
  located.base = last.cell;
  for (int i = 0; i < count; ++i) {
    const CellPosition position = cells.locate(lattice.coordinate(axis, first + i));
    const std::int64_t from_base = position.cell - located.base;
    if (from_base > 2 * reach_cells_) break;
    located.position[static_cast<std::size_t>(i)] =
        (static_cast<float>(from_base) + position.fraction) * cell_in_radii_;
    located.count = i + 1;
    last = position;
  }
  located.rows = static_cast<int>(last.cell - located.base) + 2 * reach_cells_;
  return located;
}

template <int Dim>
void GradientEvaluator<Dim>::evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples,
                                      const KnownGradients<Dim>& known) const {
  TileSpan span;
  const auto locate_axis = [&](int axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    int role = 0;
    while (axis_of_role<Dim>(role) != axis) ++role;
    const int count = std::min(samples_per_tile<Dim>(role), lattice.count[axis] - span.first[a]);
    span.axes[a] = locate(lattice, axis, span.first[a], count);
  };

  // Step through the tiles like an odometer, the last axis fastest; an axis is located when its tile changes.
  for (int axis = 0; axis < Dim; ++axis) locate_axis(axis);
  while (true) {
    evaluate_tile(lattice, span, known, samples);
    int axis = Dim - 1;
    for (; axis >= 0; --axis) {
      const std::size_t a = static_cast<std::size_t>(axis);
      span.first[a] += span.axes[a].count;
      if (span.first[a] < lattice.count[axis]) break;
      span.first[a] = 0;
      locate_axis(axis);
    }
    if (axis < 0) return;
    locate_axis(axis);
  }
}

template <int Dim>
void GradientEvaluator<Dim>::evaluate_tile(const Lattice<Dim>& lattice, const TileSpan& span,
                                           const KnownGradients<Dim>& known,
                                           const Samples<Dim>& samples) const {
  GradientTile tile;
  std::array<const LocatedAxis*, kGradientRoles> located{};
  for (int role = 0; role < kGradientRoles; ++role) {
    const int axis = axis_of_role<Dim>(role);
    if (axis >= 0) located[static_cast<std::size_t>(role)] = &span.axes[static_cast<std::size_t>(axis)];
  }

  // Samples. Entries past the last repeat it.
  const auto sample = [&](int role, int group, int i) {
    const LocatedAxis& axis = *located[static_cast<std::size_t>(role)];
    const int index = std::min(group * samples_per_group<Dim>(role) + i, axis.count - 1);
    return axis.position[static_cast<std::size_t>(index)];
  };
  for (int role = 0; role < kGradientRoles; ++role) {
    const LocatedAxis* axis = located[static_cast<std::size_t>(role)];
    if (axis != nullptr && axis->count > samples_per_group<Dim>(role)) tile.groups[role] = 2;
  }
  for (int group = 0; group < 2; ++group) {
    for (int lane = 0; lane < GradientTile::kLanes; ++lane) {
      if (located[kMid] != nullptr) tile.mid[group][lane] = sample(kMid, group, lane / kFastLanes<Dim>);
      tile.fast[group][lane] = sample(kFast, group, lane % kFastLanes<Dim>);
    }
    for (int i = 0; i < GradientTile::kSlow; ++i) {
      if (located[kSlow] != nullptr) tile.slow[group][i] = sample(kSlow, group, i);
    }
  }
  if (located[kOuter] != nullptr) tile.outer = located[kOuter]->position[0];

  // Rows of lattice points.
  CellBox<Dim> cells;
  for (int role = 0; role < kGradientRoles; ++role) {
    const int axis = axis_of_role<Dim>(role);
    if (axis < 0) continue;
    const LocatedAxis& from = *located[static_cast<std::size_t>(role)];
    tile.lattice.first[role] = static_cast<float>(1 - reach_cells_) * cell_in_radii_;
    tile.lattice.rows[role] = from.rows;
    cells.first[axis] = from.base - reach_cells_ + 1;
    cells.count[axis] = from.rows;
  }

  // Their gradients: among the known ones, or looked up here.
  bool is_known = !known.indices.empty();
  for (int axis = 0; is_known && axis < Dim; ++axis) {
    is_known = cells.first[axis] >= known.cells.first[axis] &&
               cells.first[axis] + cells.count[axis] <= known.cells.first[axis] + known.cells.count[axis];
  }
  constexpr std::size_t kMostRows = GradientTile::kMaxRows;
  constexpr std::size_t kMostCells = Dim == 4   ? kMostRows * kMostRows * kMostRows * kMostRows
                                     : Dim == 3 ? kMostRows * kMostRows * kMostRows
                                                : kMostRows * kMostRows;
  std::array<std::uint8_t, kMostCells> looked_up;
  const CellBox<Dim>& stored = is_known ? known.cells : cells;
  if (!is_known) lattice_.gradient_indices(cells, looked_up.data());
  const std::uint8_t* indices = is_known ? known.indices.data() : looked_up.data();
  std::ptrdiff_t stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    indices += (cells.first[axis] - stored.first[axis]) * stride;
    int role = 0;
    while (axis_of_role<Dim>(role) != axis) ++role;
    tile.lattice.stride[role] = static_cast<int>(stride);
    stride *= stored.count[axis];
  }
  tile.lattice.gradient_index = indices;

  GradientTileResults results;
  GradientSum sum = sum_;
  sum.gradients = gradients_;
  const GradientOutput output =
      samples.wants_gradient() ? GradientOutput::value_and_derivative : GradientOutput::value;
  sum_gradient_noise(sum, tile, output, results);

  // Scatter.
  std::array<std::size_t, kGradientRoles> lattice_stride{};
  std::array<int, kGradientRoles> count{1, 1, 1, 1};
  std::size_t offset = 0;
  std::size_t sample_stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    int role = 0;
    while (axis_of_role<Dim>(role) != axis) ++role;
    lattice_stride[static_cast<std::size_t>(role)] = sample_stride;
    count[static_cast<std::size_t>(role)] = span.axes[static_cast<std::size_t>(axis)].count;
    offset += static_cast<std::size_t>(span.first[static_cast<std::size_t>(axis)]) * sample_stride;
    sample_stride *= static_cast<std::size_t>(lattice.count[axis]);
  }
  const auto scatter = [&](const float* from, float* to, float factor) {
    constexpr int kRun = kFastLanes<Dim>;
    for (int slow = 0; slow < count[kSlow]; ++slow) {
      for (int mid = 0; mid < count[kMid]; ++mid) {
        float* row = to + static_cast<std::size_t>(slow) * lattice_stride[kSlow] +
                     static_cast<std::size_t>(mid) * lattice_stride[kMid];
        for (int fast = 0; fast < count[kFast]; fast += kRun) {
          const int group =
              GradientTile::group_index(slow / GradientTile::kSlow, mid / kMidLanes<Dim>, fast / kRun);
          const float* run = from + group * GradientTile::kGroupSamples +
                             (slow % GradientTile::kSlow) * GradientTile::kLanes +
                             (mid % kMidLanes<Dim>)*kRun;
          const int last = std::min(kRun, count[kFast] - fast);
          for (int i = 0; i < last; ++i) {
            row[static_cast<std::size_t>(fast + i) * lattice_stride[kFast]] = run[i] * factor;
          }
        }
      }
    }
  };
  scatter(results.value, samples.values.data() + offset, 1.0f);
  if (!samples.wants_gradient()) return;
  for (int role = 0; role < kGradientRoles; ++role) {
    const int axis = axis_of_role<Dim>(role);
    if (axis < 0) continue;
    const std::size_t a = static_cast<std::size_t>(axis);
    scatter(results.derivative[role], samples.gradient[a].data() + offset, per_radius_[a]);
  }
}

template <int Dim>
void GradientEvaluator<Dim>::evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const {
  for (std::size_t first = 0; first < points.count; first += kPointBatch) {
    evaluate_batch(points, first, std::min(kPointBatch, points.count - first), samples);
  }
}

template <int Dim>
void GradientEvaluator<Dim>::evaluate_batch(const Points<Dim>& points, std::size_t first, std::size_t count,
                                            const Samples<Dim>& samples) const {
  // Locate the points, and order them so that those of one cell follow each other. The key need not tell all
  // cells apart: it decides the speed, not the result.
  std::vector<LocatedPoint> located(count);
  std::vector<std::pair<std::uint64_t, std::size_t>> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    LocatedPoint& point = located[i];
    point.index = first + i;
    std::uint64_t key = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const std::size_t a = static_cast<std::size_t>(axis);
      const CellPosition position = axes_[a].locate(points.coordinate(point.index, axis));
      point.cell[axis] = position.cell;
      point.fraction[a] = position.fraction;
      key = key << 16 | (static_cast<std::uint64_t>(position.cell) & 0xffffu);
    }
    order[i] = {key, i};
  }
  if (!std::is_sorted(order.begin(), order.end())) std::sort(order.begin(), order.end());

  // The rows of lattice points around a cell.
  GradientCluster cluster;
  const int rows = 2 * reach_cells_;
  CellBox<Dim> cells;
  int stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    int role = 0;
    while (axis_of_role<Dim>(role) != axis) ++role;
    cluster.lattice.first[role] = static_cast<float>(1 - reach_cells_) * cell_in_radii_;
    cluster.lattice.rows[role] = rows;
    cluster.lattice.stride[role] = stride;
    cells.count[axis] = rows;
    stride *= rows;
  }
  std::array<std::uint8_t, 256> indices;  // 4 rows per axis at most, in at most 4 dimensions
  cluster.lattice.gradient_index = indices.data();
  GradientSum sum = sum_;
  sum.gradients = gradients_;
  const GradientOutput output =
      samples.wants_gradient() ? GradientOutput::value_and_derivative : GradientOutput::value;

  std::size_t next = 0;
  GradientClusterResults results;
  std::array<std::size_t, GradientCluster::kSamples> members;
  const Index<Dim>* current = nullptr;
  while (next < count) {
    // Gather a cluster of points of one cell.
    const LocatedPoint& leader = located[order[next].second];
    cluster.count = 0;
    while (next < count && cluster.count < GradientCluster::kSamples) {
      const LocatedPoint& point = located[order[next].second];
      if (point.cell != leader.cell) break;
      for (int role = 0; role < kGradientRoles; ++role) {
        const int axis = axis_of_role<Dim>(role);
        if (axis < 0) continue;
        cluster.position[role][cluster.count] =
            point.fraction[static_cast<std::size_t>(axis)] * cell_in_radii_;
      }
      members[static_cast<std::size_t>(cluster.count++)] = point.index;
      ++next;
    }
    if (current == nullptr || *current != leader.cell) {
      for (int axis = 0; axis < Dim; ++axis) cells.first[axis] = leader.cell[axis] - reach_cells_ + 1;
      lattice_.gradient_indices(cells, indices.data());
      current = &leader.cell;
    }

    sum_gradient_noise(sum, cluster, output, results);

    for (int i = 0; i < cluster.count; ++i) {
      const std::size_t index = members[static_cast<std::size_t>(i)];
      samples.values[index] = results.value[i];
      if (!samples.wants_gradient()) continue;
      for (int role = 0; role < kGradientRoles; ++role) {
        const int axis = axis_of_role<Dim>(role);
        if (axis < 0) continue;
        const std::size_t a = static_cast<std::size_t>(axis);
        samples.gradient[a][index] = results.derivative[role][i] * per_radius_[a];
      }
    }
  }
}

template class GradientEvaluator<1>;
template class GradientEvaluator<2>;
template class GradientEvaluator<3>;
template class GradientEvaluator<4>;

}  // namespace solidnoise
