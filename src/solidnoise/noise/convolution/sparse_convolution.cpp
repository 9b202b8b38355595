#include "solidnoise/noise/convolution/sparse_convolution.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "solidnoise/noise/convolution/cell_sums.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/sparse_convolution_source.h"

namespace solidnoise {

template <int Dim>
SparseConvolution<Dim>::SparseConvolution(ImpulseProcess<Dim> process,
                                          std::shared_ptr<const ImpulseKernel> kernel,
                                          const std::array<double, Dim>& radius, double amplitude)
    : process_(std::move(process)),
      kernel_(std::move(kernel)),
      scale_(support_scale<Dim>(radius)),
      amplitude_(amplitude) {
  for (int axis = 0; axis < Dim; ++axis) {
    reach_[axis] = static_cast<std::int64_t>(std::ceil(radius[axis]));
    slope_[axis] = static_cast<float>(amplitude / (radius[axis] * process_.axes()[axis].size()));
  }
}

namespace {

constexpr std::uint32_t kShortRow = 16;  // impulses that are culled at once

}  // namespace

// Culls the source's impulses to those whose kernel meets the neighbourhood.
template <int Dim>
void SparseConvolution<Dim>::gather(const Source& source, const Neighbourhood& neighbourhood,
                                    ImpulseList& list) const {
  const CullBox box{
      Dim, kernel_->attribute_count(), kernel_->support(), neighbourhood.lower, neighbourhood.upper, scale_};
  ImpulseRun run;
  const Index<Dim>& origin = source.impulses.first_cell();
  for (int axis = 0; axis < Dim; ++axis) {
    run.anchor[role_of_axis<Dim>(axis)] =
        static_cast<std::int32_t>((neighbourhood.first[axis] - origin[axis]) * ImpulseBlock<Dim>::kQuanta);
  }

  list.clear();
  // Takes the impulses of a contiguous run.
  const auto cull = [&](std::uint32_t begin, std::uint32_t end) {
    if (begin == end) return;
    for (int axis = 0; axis < Dim; ++axis) {
      run.position[role_of_axis<Dim>(axis)] = source.impulses.position(axis) + begin;
    }
    for (int channel = 0; channel < box.attributes; ++channel) {
      run.attribute[channel] = source.attributes[channel].data() + begin;
    }
    run.count = end - begin;
    cull_impulses(run, box, list);
  };
  constexpr int kLast = Dim - 1;
  const Index<Dim> first = neighbourhood.first - reach_;
  const Index<Dim> last = neighbourhood.last + reach_;
  const auto row = [&](const Index<Dim>& cell) {
    return source.impulses.run(cell, first[kLast], last[kLast]);
  };
  if constexpr (Dim == 1) {
    const auto only = row(first);
    cull(only.begin, only.end);
  } else {
    // Rows follow each other in the block: where they are short, those of a plane are taken together, with
    // what lies between them.
    constexpr int kRow = Dim - 2;
    const auto rows = static_cast<std::uint32_t>(last[kRow] - first[kRow] + 1);
    Index<Dim> cell = first;
    do {
      Index<Dim> end = cell;
      end[kRow] = last[kRow];
      const std::uint32_t begin = row(cell).begin;
      const std::uint32_t past = row(end).end;
      if (past - begin <= rows * kShortRow) {
        cull(begin, past);
        cell = end;
      } else {
        const auto [from, to] = row(cell);
        cull(from, to);
      }
      cell[kLast] = last[kLast];
    } while (next_cell<Dim>(cell, first, last));
  }
}

// The impulses around a group of points, for sum_by_cell().
template <int Dim>
class SparseConvolution<Dim>::PointSource {
 public:
  PointSource(const SparseConvolution& noise, Derivatives derivatives)
      : noise_(noise), derivatives_(derivatives) {}

  const std::array<CellAxis, Dim>& axes() const { return noise_.process_.axes(); }

  // The points of a group, as long as they have more impulses by themselves than together.
  std::size_t enter(std::span<const CellPoint<Dim>> group) {
    const double single = cells_around(cells_of(group.first(1)));
    std::size_t count = group.size();
    if (cells_around(cells_of(group)) > single * static_cast<double>(count)) {
      CellSpan<Dim> cells = cells_of(group.first(1));
      for (count = 1; count < group.size(); ++count) {
        const CellSpan<Dim> both = joined(cells, group[count]);
        if (cells_around(both) > cells_around(cells) + single) break;
        cells = both;
      }
    }
    source_.emplace(noise_.process_, *noise_.kernel_, noise_.reach_of(neighbourhood_of(group.first(count))));
    return count;
  }

  bool may_share(const CellPoint<Dim>&, const CellPoint<Dim>&) const { return true; }

  const ClusterSums& sum(std::span<const CellPoint<Dim>> points) {
    const Neighbourhood neighbourhood = neighbourhood_of(points);
    cluster_.count = static_cast<int>(points.size());
    for (int axis = 0; axis < Dim; ++axis) {
      float* const coordinates = cluster_.coordinate[role(axis)];
      for (std::size_t i = 0; i < SampleCluster::kSamples; ++i) {
        coordinates[i] = coordinate(points[std::min(i, points.size() - 1)], axis, neighbourhood);
      }
    }
    noise_.gather(*source_, neighbourhood, list_);
    noise_.kernel_->sum(list_, cluster_, derivatives_, sums_);
    return sums_;
  }

  int role(int axis) const { return role_of_axis<Dim>(axis); }
  float amplitude() const { return static_cast<float>(noise_.amplitude_); }
  float slope(int axis) const { return noise_.slope_[axis]; }

 private:
  static float coordinate(const CellPoint<Dim>& point, int axis, const Neighbourhood& neighbourhood) {
    const float fraction = point.fraction[static_cast<std::size_t>(axis)];
    return from_anchor({point.cell[axis], fraction}, neighbourhood.first[axis]);
  }

  static Neighbourhood neighbourhood_of(std::span<const CellPoint<Dim>> points) {
    const CellSpan<Dim> cells = cells_of(points);
    Neighbourhood neighbourhood{cells.first, cells.last, {}, {}};
    for (int axis = 0; axis < Dim; ++axis) {
      const Role role = role_of_axis<Dim>(axis);
      neighbourhood.lower[role] = neighbourhood.upper[role] = coordinate(points.front(), axis, neighbourhood);
      for (const CellPoint<Dim>& point : points) {
        neighbourhood.include(role, coordinate(point, axis, neighbourhood));
      }
    }
    return neighbourhood;
  }

  // Cells that impulses may lie in that reach points of some cells.
  double cells_around(const CellSpan<Dim>& cells) const {
    double product = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      product *= static_cast<double>(cells.last[axis] - cells.first[axis] + 2 * noise_.reach_[axis] + 1);
    }
    return product;
  }

  const SparseConvolution& noise_;
  Derivatives derivatives_;
  std::optional<Source> source_;
  ImpulseList list_{Dim};
  SampleCluster cluster_;
  ClusterSums sums_;
};

template <int Dim>
void SparseConvolution<Dim>::evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const {
  if (!kernel_) return fill_with_zero(samples);
  sum_by_cell(points, samples, PointSource(*this, derivatives_of(samples)));
}

template class SparseConvolution<1>;
template class SparseConvolution<2>;
template class SparseConvolution<3>;
template class SparseConvolution<4>;

}  // namespace solidnoise
