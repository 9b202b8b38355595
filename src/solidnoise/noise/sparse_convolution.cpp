#include "solidnoise/noise/sparse_convolution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "solidnoise/noise/impulse_sums.h"

namespace solidnoise {
namespace {

// Blocks with more cells than this make their impulses brick by brick, to bound memory.
constexpr double kMaxCellsInBlock = 1 << 18;

// One axis of a lattice, located in the cells.
struct LocatedAxis {
  std::vector<CellPosition> positions;
  int brick_side = 1;  // samples of one brick

  template <int Dim>
  LocatedAxis(const Lattice<Dim>& lattice, const CellAxis& cells, int axis) {
    positions.reserve(static_cast<std::size_t>(lattice.count[axis]));
    for (int i = 0; i < lattice.count[axis]; ++i)
      positions.push_back(cells.locate(lattice.coordinate(axis, i)));
    const double samples = CellAxis::kMaxSpan * cells.size() / lattice.step[axis];
    brick_side = samples >= SampleBrick::kSide ? SampleBrick::kSide : std::max(1, static_cast<int>(samples));
  }
};

// Exact position of `position` relative to the corner of cell `anchor`, in cells.
float from_anchor(const CellPosition& position, std::int64_t anchor) {
  return static_cast<float>(position.cell - anchor) + position.fraction;
}

}  // namespace

// Impulses and their attributes.
template <int Dim>
struct SparseConvolution<Dim>::Source {
  Source(const ImpulseProcess<Dim>& process, const ImpulseKernel& kernel,
         const typename ImpulseBlock<Dim>::Reach& reach)
      : impulses(process, reach) {
    for (int channel = 0; channel < kernel.attribute_count(); ++channel) {
      attributes[channel].resize(impulses.size() + ImpulseList::kPadding);
    }
    kernel.draw(impulses.marks(), attributes);
  }

  ImpulseBlock<Dim> impulses;
  ImpulseAttributes attributes;
};

// Where the samples of a brick or cluster are: the anchor cell, the cells they lie in, and their bounds per
// role in cells from the anchor.
template <int Dim>
struct SparseConvolution<Dim>::Neighborhood {
  Index<Dim> first{0};  // the anchor
  Index<Dim> last{0};
  std::array<float, kRoles> lower{};
  std::array<float, kRoles> upper{};
};

template <int Dim>
SparseConvolution<Dim>::SparseConvolution(ImpulseProcess<Dim> process,
                                          std::shared_ptr<const ImpulseKernel> kernel,
                                          const std::array<double, Dim>& radius, double amplitude)
    : process_(std::move(process)),
      kernel_(std::move(kernel)),
      scale_(support_scale<Dim>(radius)),
      amplitude_(amplitude) {
  for (int axis = 0; axis < Dim; ++axis) {
    slope_[axis] = static_cast<float>(amplitude / (radius[axis] * process_.axes()[axis].size()));
  }
}

// Culls the source's impulses to those whose kernel meets the neighborhood.
template <int Dim>
void SparseConvolution<Dim>::gather(const Source& source, const Neighborhood& neighborhood,
                                    ImpulseList& list) const {
  CullBox box{kernel_->support(), neighborhood.lower, neighborhood.upper, scale_};
  ImpulseRun run;
  run.dimensions = Dim;
  run.attributes = kernel_->attribute_count();
  const Index<Dim>& origin = source.impulses.first_cell();
  for (int axis = 0; axis < Dim; ++axis) {
    run.role[axis] = role_of_axis<Dim>(axis);
    run.anchor[axis] =
        static_cast<std::int32_t>((neighborhood.first[axis] - origin[axis]) * ImpulseBlock<Dim>::kQuanta);
  }

  list.clear();
  constexpr int kLast = Dim - 1;
  Index<Dim> cell = neighborhood.first - std::int64_t{1};
  while (true) {
    const auto [begin, end] =
        source.impulses.run(cell, neighborhood.first[kLast] - 1, neighborhood.last[kLast] + 1);
    if (begin != end) {
      for (int axis = 0; axis < Dim; ++axis) run.position[axis] = source.impulses.position(axis) + begin;
      for (int channel = 0; channel < run.attributes; ++channel) {
        run.attribute[channel] = source.attributes[channel].data() + begin;
      }
      run.count = end - begin;
      cull_impulses(run, box, list);
    }
    int axis = kLast - 1;
    while (axis >= 0 && ++cell[axis] > neighborhood.last[axis] + 1) {
      cell[axis] = neighborhood.first[axis] - 1;
      --axis;
    }
    if (axis < 0) return;
  }
}

template <int Dim>
class SparseConvolution<Dim>::Block final : public NoiseBlock<Dim> {
 public:
  Block(const SparseConvolution& noise, const Box<Dim>& box) : noise_(noise) {
    const auto reach = ImpulseBlock<Dim>::reach_of(noise_.process_.axes(), box);
    bool fits = reach.cells() <= kMaxCellsInBlock;
    for (int axis = 0; axis < Dim; ++axis) {
      fits = fits && reach.last[axis] - reach.first[axis] < ImpulseBlock<Dim>::kMaxCellsPerAxis;
    }
    if (fits) source_.emplace(noise_.process_, *noise_.kernel_, reach);
  }

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    std::vector<LocatedAxis> axes;
    for (int axis = 0; axis < Dim; ++axis) axes.emplace_back(lattice, noise_.process_.axes()[axis], axis);

    ImpulseList list(Dim);
    glm::vec<Dim, int> start(0);
    while (true) {
      evaluate_brick(lattice, axes, start, list, samples);
      int axis = Dim - 1;
      while (axis >= 0 && (start[axis] += side(axes, axis)) >= lattice.count[axis]) start[axis--] = 0;
      if (axis < 0) return;
    }
  }

 private:
  // A brick has one sample in time.
  static int side(const std::vector<LocatedAxis>& axes, int axis) {
    return role_of_axis<Dim>(axis) == kT ? 1 : axes[axis].brick_side;
  }

  void evaluate_brick(const Lattice<Dim>& lattice, const std::vector<LocatedAxis>& axes,
                      const glm::vec<Dim, int>& start, ImpulseList& list, const Samples<Dim>& samples) const {
    SampleBrick brick;
    Neighborhood neighborhood;
    for (int axis = 0; axis < Dim; ++axis) {
      const Role role = role_of_axis<Dim>(axis);
      const CellPosition* positions = axes[axis].positions.data() + start[axis];
      const int count = std::min(side(axes, axis), lattice.count[axis] - start[axis]);
      neighborhood.first[axis] = positions[0].cell;
      neighborhood.last[axis] = positions[count - 1].cell;
      neighborhood.lower[role] = from_anchor(positions[0], positions[0].cell);
      neighborhood.upper[role] = from_anchor(positions[count - 1], positions[0].cell);
      if (role == kT) {
        brick.time = neighborhood.lower[role];
        continue;
      }
      brick.count[role] = count;
      for (int i = 0; i < SampleBrick::kSide; ++i) {
        brick.coordinate[role][i] = from_anchor(positions[std::min(i, count - 1)], positions[0].cell);
      }
    }

    std::optional<Source> local;
    if (!source_) {
      typename ImpulseBlock<Dim>::Reach reach{
          neighborhood.first - std::int64_t{1}, neighborhood.last + std::int64_t{1}, {}, {}};
      reach.into_last.fill(1.0f);
      local.emplace(noise_.process_, *noise_.kernel_, reach);
    }
    noise_.gather(source_ ? *source_ : *local, neighborhood, list);

    BrickSums sums;
    const bool gradient = samples.wants_gradient();
    noise_.kernel_->sum(list, brick, gradient ? Derivatives::gradient : Derivatives::none, sums);
    scatter(lattice, start, brick, sums.value, static_cast<float>(noise_.amplitude_), samples.values);
    for (int axis = 0; gradient && axis < Dim; ++axis) {
      scatter(lattice, start, brick, sums.gradient[role_of_axis<Dim>(axis)], noise_.slope_[axis],
              samples.gradient[axis]);
    }
  }

  // Writes a brick's sums, times `factor`, to where the lattice has these samples.
  static void scatter(const Lattice<Dim>& lattice, const glm::vec<Dim, int>& start, const SampleBrick& brick,
                      const float* sums, float factor, std::span<float> values) {
    std::array<std::ptrdiff_t, kRoles> stride{};
    std::ptrdiff_t offset = 0;
    std::ptrdiff_t axis_stride = 1;
    for (int axis = Dim - 1; axis >= 0; --axis) {
      stride[role_of_axis<Dim>(axis)] = axis_stride;
      offset += axis_stride * start[axis];
      axis_stride *= lattice.count[axis];
    }
    constexpr int kSide = SampleBrick::kSide;
    for (int x = 0; x < brick.count[kX]; ++x) {
      for (int y = 0; y < brick.count[kY]; ++y) {
        float* const row = values.data() + offset + x * stride[kX] + y * stride[kY];
        const float* const sum = sums + (x * kSide + y) * kSide;
        for (int z = 0; z < brick.count[kZ]; ++z) row[z * stride[kZ]] = factor * sum[z];
      }
    }
  }

  SparseConvolution noise_;
  std::optional<Source> source_;
};

template <int Dim>
std::unique_ptr<NoiseBlock<Dim>> SparseConvolution<Dim>::block(const Box<Dim>& box) const {
  return std::make_unique<Block>(*this, box);
}

template <int Dim>
void SparseConvolution<Dim>::evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const {
  // Sort the points by groups of cells, then by cell: points of one group share their impulses.
  constexpr std::int64_t kGroupShift = 2;
  struct Located {
    Index<Dim> cell;
    std::array<float, Dim> fraction;
    std::size_t sample;
  };
  std::vector<Located> located(points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    located[i].sample = i;
    for (int axis = 0; axis < Dim; ++axis) {
      const CellPosition position = process_.axes()[axis].locate(points.coordinate(i, axis));
      located[i].cell[axis] = position.cell;
      located[i].fraction[axis] = position.fraction;
    }
  }
  const auto group_differs = [](const Located& a, const Located& b) {
    for (int axis = 0; axis < Dim; ++axis) {
      if (a.cell[axis] >> kGroupShift != b.cell[axis] >> kGroupShift) return true;
    }
    return false;
  };
  std::sort(located.begin(), located.end(), [](const Located& a, const Located& b) {
    for (int axis = 0; axis < Dim; ++axis) {
      const std::int64_t group_a = a.cell[axis] >> kGroupShift;
      const std::int64_t group_b = b.cell[axis] >> kGroupShift;
      if (group_a != group_b) return group_a < group_b;
    }
    for (int axis = 0; axis < Dim; ++axis) {
      if (a.cell[axis] != b.cell[axis]) return a.cell[axis] < b.cell[axis];
    }
    return a.sample < b.sample;
  });

  const auto bounds = [](auto begin, auto end) {
    typename ImpulseBlock<Dim>::Reach range{begin->cell, begin->cell, {}, {}};
    range.into_last.fill(1.0f);
    for (auto it = begin; it != end; ++it) {
      for (int axis = 0; axis < Dim; ++axis) {
        range.first[axis] = std::min(range.first[axis], it->cell[axis]);
        range.last[axis] = std::max(range.last[axis], it->cell[axis]);
      }
    }
    return range;
  };

  const Derivatives derivatives = samples.wants_gradient() ? Derivatives::gradient : Derivatives::none;
  ImpulseList list(Dim);
  ClusterSums sums;
  for (auto group = located.begin(); group != located.end();) {
    auto group_end = group;
    while (group_end != located.end() && !group_differs(*group, *group_end)) ++group_end;
    auto range = bounds(group, group_end);
    for (int axis = 0; axis < Dim; ++axis) {
      --range.first[axis];
      ++range.last[axis];
    }
    const Source source(process_, *kernel_, range);

    for (auto begin = group; begin != group_end;) {
      const auto end = begin + std::min<std::ptrdiff_t>(SampleCluster::kSamples, group_end - begin);
      const auto cells = bounds(begin, end);
      SampleCluster cluster;
      cluster.count = static_cast<int>(end - begin);
      Neighborhood neighborhood{cells.first, cells.last, {}, {}};
      for (int axis = 0; axis < Dim; ++axis) {
        const Role role = role_of_axis<Dim>(axis);
        float* const coordinates = cluster.coordinate[role];
        for (int i = 0; i < SampleCluster::kSamples; ++i) {
          const Located& point = begin[std::min(i, cluster.count - 1)];
          coordinates[i] = from_anchor({point.cell[axis], point.fraction[axis]}, cells.first[axis]);
        }
        const auto [lower, upper] = std::minmax_element(coordinates, coordinates + cluster.count);
        neighborhood.lower[role] = *lower;
        neighborhood.upper[role] = *upper;
      }
      gather(source, neighborhood, list);
      kernel_->sum(list, cluster, derivatives, sums);

      for (int i = 0; i < cluster.count; ++i) {
        const std::size_t sample = begin[i].sample;
        samples.values[sample] = static_cast<float>(amplitude_) * sums.value[i];
        for (int axis = 0; derivatives == Derivatives::gradient && axis < Dim; ++axis) {
          samples.gradient[axis][sample] = slope_[axis] * sums.gradient[role_of_axis<Dim>(axis)][i];
        }
      }
      begin = end;
    }
    group = group_end;
  }
}

template class SparseConvolution<1>;
template class SparseConvolution<2>;
template class SparseConvolution<3>;
template class SparseConvolution<4>;

}  // namespace solidnoise
