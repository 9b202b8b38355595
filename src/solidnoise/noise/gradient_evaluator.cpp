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

template <int Dim>
GradientOutput output_for(const Samples<Dim>& samples) {
  return samples.wants_gradient() ? GradientOutput::value_and_derivative : GradientOutput::value;
}

}  // namespace

// Samples of one axis of a tile: positions in radii from the lower corner of cell `base`; entries past the
// last repeat it. `rows`: of lattice points that may reach them, from base - reach + 1.
template <int Dim>
struct GradientEvaluator<Dim>::LocatedAxis {
  int count = 0;
  std::int64_t base = 0;
  int rows = 0;
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
  sum_.gradients = gradients_;
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
                                                                            int axis, int first) const {
  constexpr std::int64_t kQuanta = CellAxis::kQuantaPerCell;
  const CellAxis& cells = axes_[static_cast<std::size_t>(axis)];
  const int role = role_of_axis<Dim>(axis);
  const int wanted = std::min(samples_per_tile<Dim>(role), lattice.count[axis] - first);
  const std::int64_t most = (2 * reach_cells_ + 1) * kQuanta;
  const float radii_per_quantum = cell_in_radii_ / static_cast<float>(kQuanta);

  LocatedAxis located;
  located.base = cells.quanta(lattice.coordinate(axis, first)) >> CellAxis::kFractionBits;
  std::int64_t last = 0;
  for (int i = 0; i < wanted; ++i) {
    const std::int64_t position = cells.quanta(lattice.coordinate(axis, first + i)) - located.base * kQuanta;
    if (position >= most) break;
    last = position;
    located.position[static_cast<std::size_t>(i)] =
        static_cast<float>(static_cast<std::int32_t>(position)) * radii_per_quantum;
    located.count = i + 1;
  }
  located.rows = static_cast<int>(last >> CellAxis::kFractionBits) + 2 * reach_cells_;
  for (int i = located.count; i < samples_per_tile<Dim>(role); ++i) {
    located.position[static_cast<std::size_t>(i)] =
        located.position[static_cast<std::size_t>(located.count - 1)];
  }
  return located;
}

template <int Dim>
void GradientEvaluator<Dim>::evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples,
                                      const KnownGradients<Dim>& known) const {
  TileSpan span;
  const auto locate_axis = [&](int axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    span.axes[a] = locate(lattice, axis, span.first[a]);
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
void GradientEvaluator<Dim>::place_samples(const TileSpan& span, GradientTile& tile) const {
  constexpr int kFastRun = kFastLanes<Dim>;
  const float* fast = span.axes[axis_of_role<Dim>(kFast)].position.data();
  for (int group = 0; group < 2; ++group) {
    for (int lane = 0; lane < GradientTile::kLanes; ++lane) {
      tile.fast[group][lane] = fast[group * kFastRun + lane % kFastRun];
    }
  }
  if constexpr (Dim >= 2) {
    std::copy_n(span.axes[axis_of_role<Dim>(kSlow)].position.data(), 2 * GradientTile::kSlow, tile.slow[0]);
  }
  if constexpr (Dim >= 3) {
    const float* mid = span.axes[axis_of_role<Dim>(kMid)].position.data();
    for (int group = 0; group < 2; ++group) {
      for (int lane = 0; lane < GradientTile::kLanes; ++lane) {
        tile.mid[group][lane] = mid[group * kMidLanes<Dim> + lane / kFastRun];
      }
    }
  }
  if constexpr (Dim == 4) tile.outer = span.axes[axis_of_role<Dim>(kOuter)].position[0];

  for (int axis = 0; axis < Dim; ++axis) {
    const int role = role_of_axis<Dim>(axis);
    const LocatedAxis& located = span.axes[static_cast<std::size_t>(axis)];
    if (located.count > samples_per_group<Dim>(role)) tile.groups[role] = 2;
    tile.lattice.first[role] = static_cast<float>(1 - reach_cells_) * cell_in_radii_;
    tile.lattice.rows[role] = located.rows;
  }
}

template <int Dim>
void GradientEvaluator<Dim>::place_gradients(const TileSpan& span, const KnownGradients<Dim>& known,
                                             LookedUp& looked_up, GradientTile& tile) const {
  CellBox<Dim> cells;
  bool is_known = !known.indices.empty();
  for (int axis = 0; axis < Dim; ++axis) {
    const LocatedAxis& located = span.axes[static_cast<std::size_t>(axis)];
    cells.first[axis] = located.base - reach_cells_ + 1;
    cells.count[axis] = located.rows;
    is_known = is_known && cells.first[axis] >= known.cells.first[axis] &&
               cells.first[axis] + cells.count[axis] <= known.cells.first[axis] + known.cells.count[axis];
  }
  if (!is_known) lattice_.gradient_indices(cells, looked_up.data());

  const CellBox<Dim>& stored = is_known ? known.cells : cells;
  const std::uint8_t* indices = is_known ? known.indices.data() : looked_up.data();
  std::ptrdiff_t stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    indices += (cells.first[axis] - stored.first[axis]) * stride;
    tile.lattice.stride[role_of_axis<Dim>(axis)] = static_cast<int>(stride);
    stride *= stored.count[axis];
  }
  tile.lattice.gradient_index = indices;
}

template <int Dim>
void GradientEvaluator<Dim>::scatter(const float* results, float factor, const Lattice<Dim>& lattice,
                                     const TileSpan& span, float* samples) const {
  std::array<std::size_t, kGradientRoles> stride{};
  std::array<int, kGradientRoles> count{1, 1, 1, 1};
  std::size_t next_stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    const std::size_t role = static_cast<std::size_t>(role_of_axis<Dim>(axis));
    stride[role] = next_stride;
    count[role] = span.axes[a].count;
    samples += static_cast<std::size_t>(span.first[a]) * next_stride;
    next_stride *= static_cast<std::size_t>(lattice.count[axis]);
  }

  constexpr int kRun = kFastLanes<Dim>;
  const bool is_whole = stride[kFast] == 1 && count[kFast] % kRun == 0;
  for (int slow = 0; slow < count[kSlow]; ++slow) {
    for (int mid = 0; mid < count[kMid]; ++mid) {
      float* row = samples + static_cast<std::size_t>(slow) * stride[kSlow] +
                   static_cast<std::size_t>(mid) * stride[kMid];
      const float* lanes = results +
                           GradientTile::group_index(slow / GradientTile::kSlow, mid / kMidLanes<Dim>, 0) *
                               GradientTile::kGroupSamples +
                           slow % GradientTile::kSlow * GradientTile::kLanes + mid % kMidLanes<Dim> * kRun;
      for (int fast = 0; fast < count[kFast]; fast += kRun) {
        // Whole runs of neighbours, the usual case, are copied with a constant length.
        if (is_whole) {
          for (int i = 0; i < kRun; ++i) row[fast + i] = lanes[i] * factor;
        } else {
          const int last = std::min(kRun, count[kFast] - fast);
          for (int i = 0; i < last; ++i)
            row[static_cast<std::size_t>(fast + i) * stride[kFast]] = lanes[i] * factor;
        }
        lanes += GradientTile::kGroupSamples;
      }
    }
  }
}

template <int Dim>
void GradientEvaluator<Dim>::evaluate_tile(const Lattice<Dim>& lattice, const TileSpan& span,
                                           const KnownGradients<Dim>& known,
                                           const Samples<Dim>& samples) const {
  GradientTile tile;
  LookedUp looked_up;
  place_samples(span, tile);
  place_gradients(span, known, looked_up, tile);

  GradientTileResults results;
  sum_gradient_noise(sum_, tile, output_for(samples), results);

  scatter(results.value, 1.0f, lattice, span, samples.values.data());
  if (!samples.wants_gradient()) return;
  for (int axis = 0; axis < Dim; ++axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    scatter(results.derivative[role_of_axis<Dim>(axis)], per_radius_[a], lattice, span,
            samples.gradient[a].data());
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
    const int role = role_of_axis<Dim>(axis);
    cluster.lattice.first[role] = static_cast<float>(1 - reach_cells_) * cell_in_radii_;
    cluster.lattice.rows[role] = rows;
    cluster.lattice.stride[role] = stride;
    cells.count[axis] = rows;
    stride *= rows;
  }
  std::array<std::uint8_t, 256> indices;  // 4 rows per axis at most, in at most 4 dimensions
  cluster.lattice.gradient_index = indices.data();

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

    sum_gradient_noise(sum_, cluster, output_for(samples), results);

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
