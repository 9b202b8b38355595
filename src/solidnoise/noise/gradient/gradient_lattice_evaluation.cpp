// Evaluation of gradient noise on lattices.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "solidnoise/noise/gradient/gradient_grid.h"

namespace solidnoise {
namespace {

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

// Room for the gradients of the lattice points that a tile is given.
constexpr std::size_t power(std::size_t base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}
template <int Dim>
using LookedUp = std::array<std::uint8_t, power(GradientTile::kMaxRows, Dim)>;

// Samples of one axis of a tile: positions in radii from the lower corner of cell `base`; entries past the
// last repeat it. `rows`: of lattice points that may reach them, from base - reach + 1.
struct TileAxis {
  int count = 0;
  std::int64_t base = 0;
  int rows = 0;
  std::array<float, kMostSamplesPerAxis> position;
};

// A tile's samples: per axis, where it begins in the lattice, and its located samples.
template <int Dim>
struct TileSpan {
  std::array<int, Dim> first{};
  std::array<TileAxis, Dim> axes;
};

// Locates samples of an axis from `first`: as many as a tile takes, or fewer if they span too many cells.
template <int Dim>
TileAxis locate(const GradientGrid<Dim>& grid, const Lattice<Dim>& lattice, int axis, int first) {
  constexpr std::int64_t kQuanta = CellAxis::kQuantaPerCell;
  const CellAxis& cells = grid.axis(axis);
  const int role = gradient_role<Dim>(axis);
  const int wanted = std::min(samples_per_tile<Dim>(role), lattice.count[axis] - first);
  const std::int64_t most = (2 * grid.reach_cells() + 1) * kQuanta;
  const float radii_per_quantum = grid.cell_in_radii() / static_cast<float>(kQuanta);

  TileAxis located;
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
  located.rows = static_cast<int>(last >> CellAxis::kFractionBits) + 2 * grid.reach_cells();
  for (int i = located.count; i < samples_per_tile<Dim>(role); ++i) {
    located.position[static_cast<std::size_t>(i)] =
        located.position[static_cast<std::size_t>(located.count - 1)];
  }
  return located;
}

// Samples and rows of lattice points.
template <int Dim>
void place_samples(const GradientGrid<Dim>& grid, const TileSpan<Dim>& span, GradientTile& tile) {
  constexpr int kFastRun = kFastLanes<Dim>;
  const float* fast = span.axes[axis_of_gradient_role<Dim>(kFast)].position.data();
  for (int group = 0; group < 2; ++group) {
    for (int lane = 0; lane < GradientTile::kLanes; ++lane) {
      tile.fast[group][lane] = fast[group * kFastRun + lane % kFastRun];
    }
  }
  if constexpr (Dim >= 2) {
    std::copy_n(span.axes[axis_of_gradient_role<Dim>(kSlow)].position.data(), 2 * GradientTile::kSlow,
                tile.slow[0]);
  }
  if constexpr (Dim >= 3) {
    const float* mid = span.axes[axis_of_gradient_role<Dim>(kMid)].position.data();
    for (int group = 0; group < 2; ++group) {
      for (int lane = 0; lane < GradientTile::kLanes; ++lane) {
        tile.mid[group][lane] = mid[group * kMidLanes<Dim> + lane / kFastRun];
      }
    }
  }
  if constexpr (Dim == 4) tile.outer = span.axes[axis_of_gradient_role<Dim>(kOuter)].position[0];

  for (int axis = 0; axis < Dim; ++axis) {
    const int role = gradient_role<Dim>(axis);
    const TileAxis& located = span.axes[static_cast<std::size_t>(axis)];
    if (located.count > samples_per_group<Dim>(role)) tile.groups[role] = 2;
    tile.lattice.first[role] = static_cast<float>(1 - grid.reach_cells()) * grid.cell_in_radii();
    tile.lattice.rows[role] = located.rows;
  }
}

// Points the tile to its gradients: the known ones, or else `looked_up`.
template <int Dim>
void place_gradients(const GradientGrid<Dim>& grid, const TileSpan<Dim>& span,
                     const KnownGradients<Dim>& known, LookedUp<Dim>& looked_up, GradientTile& tile) {
  CellBox<Dim> cells;
  bool is_known = !known.indices.empty();
  for (int axis = 0; axis < Dim; ++axis) {
    const TileAxis& located = span.axes[static_cast<std::size_t>(axis)];
    cells.first[axis] = located.base - grid.reach_cells() + 1;
    cells.count[axis] = located.rows;
    is_known = is_known && cells.first[axis] >= known.cells.first[axis] &&
               cells.first[axis] + cells.count[axis] <= known.cells.first[axis] + known.cells.count[axis];
  }
  if (!is_known) grid.lattice().gradient_indices(cells, looked_up.data());

  const CellBox<Dim>& stored = is_known ? known.cells : cells;
  const std::uint8_t* indices = is_known ? known.indices.data() : looked_up.data();
  std::ptrdiff_t stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    indices += (cells.first[axis] - stored.first[axis]) * stride;
    tile.lattice.stride[gradient_role<Dim>(axis)] = static_cast<int>(stride);
    stride *= stored.count[axis];
  }
  tile.lattice.gradient_index = indices;
}

// Copies results of a tile, times a factor, to where its samples are in the lattice.
template <int Dim>
void scatter(const float* results, float factor, const Lattice<Dim>& lattice, const TileSpan<Dim>& span,
             float* samples) {
  std::array<std::size_t, kGradientRoles> stride{};
  std::array<int, kGradientRoles> count{1, 1, 1, 1};
  std::size_t next_stride = 1;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    const std::size_t role = static_cast<std::size_t>(gradient_role<Dim>(axis));
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
          for (int i = 0; i < last; ++i) {
            row[static_cast<std::size_t>(fast + i) * stride[kFast]] = lanes[i] * factor;
          }
        }
        lanes += GradientTile::kGroupSamples;
      }
    }
  }
}

template <int Dim>
void evaluate_tile(const GradientGrid<Dim>& grid, const Lattice<Dim>& lattice, const TileSpan<Dim>& span,
                   const KnownGradients<Dim>& known, const Samples<Dim>& samples) {
  GradientTile tile;
  LookedUp<Dim> looked_up;
  place_samples(grid, span, tile);
  place_gradients(grid, span, known, looked_up, tile);

  GradientTileSums results;
  sum_gradient_noise(grid.sum(), tile, derivatives_of(samples), results);

  scatter(results.value, 1.0f, lattice, span, samples.values.data());
  if (!samples.wants_gradient()) return;
  for (int axis = 0; axis < Dim; ++axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    scatter(results.gradient[gradient_role<Dim>(axis)], grid.derivative_factor(axis), lattice, span,
            samples.gradient[a].data());
  }
}

}  // namespace

template <int Dim>
void evaluate_gradient_noise(const GradientGrid<Dim>& grid, const KnownGradients<Dim>& known,
                             const Lattice<Dim>& lattice, const Samples<Dim>& samples) {
  require_room(samples, lattice.size());
  TileSpan<Dim> span;
  const auto locate_axis = [&](int axis) {
    const std::size_t a = static_cast<std::size_t>(axis);
    span.axes[a] = locate(grid, lattice, axis, span.first[a]);
  };

  // Step through the tiles like an odometer, the last axis fastest; an axis is located when its tile changes.
  for (int axis = 0; axis < Dim; ++axis) locate_axis(axis);
  while (true) {
    evaluate_tile(grid, lattice, span, known, samples);
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

template void evaluate_gradient_noise(const GradientGrid<1>&, const KnownGradients<1>&, const Lattice<1>&,
                                      const Samples<1>&);
template void evaluate_gradient_noise(const GradientGrid<2>&, const KnownGradients<2>&, const Lattice<2>&,
                                      const Samples<2>&);
template void evaluate_gradient_noise(const GradientGrid<3>&, const KnownGradients<3>&, const Lattice<3>&,
                                      const Samples<3>&);
template void evaluate_gradient_noise(const GradientGrid<4>&, const KnownGradients<4>&, const Lattice<4>&,
                                      const Samples<4>&);

}  // namespace solidnoise
