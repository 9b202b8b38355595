#include "solidnoise/noise/convolution/sparse_convolution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solidnoise/core/points.h"
#include "solidnoise/core/random.h"
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
  Index<Dim> cell = neighborhood.first - reach_;
  while (true) {
    const auto [begin, end] =
        source.impulses.run(cell, cell[kLast], neighborhood.last[kLast] + reach_[kLast]);
    if (begin != end) {
      for (int axis = 0; axis < Dim; ++axis) run.position[axis] = source.impulses.position(axis) + begin;
      for (int channel = 0; channel < run.attributes; ++channel) {
        run.attribute[channel] = source.attributes[channel].data() + begin;
      }
      run.count = end - begin;
      cull_impulses(run, box, list);
    }
    int axis = kLast - 1;
    while (axis >= 0 && ++cell[axis] > neighborhood.last[axis] + reach_[axis]) {
      cell[axis] = neighborhood.first[axis] - reach_[axis];
      --axis;
    }
    if (axis < 0) return;
  }
}

template class SparseConvolution<1>;
template class SparseConvolution<2>;
template class SparseConvolution<3>;
template class SparseConvolution<4>;

template <int Dim>
void SparseConvolution<Dim>::evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const {
  if (!kernel_) return fill_with_zero(samples);
  // Sort the points by groups of cells, then by cell and part of it: points of one group share their
  // impulses, and those of one cluster are near each other. Groups are in the order of their hashes; two that
  // share one are only slower.
  constexpr int kGroupBits = 2;  // cells of a group along each axis, and parts of a cell
  constexpr int kHashBits = 32;
  struct Located {
    Index<Dim> cell;
    std::array<float, Dim> fraction;
    std::size_t sample;
  };
  std::vector<KeyedPoint> order(points.size());
  std::vector<Located> unsorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Located& point = unsorted[i];
    point.sample = i;
    Index<Dim> group;
    std::uint64_t cell = 0;
    std::uint64_t part = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const CellPosition position = process_.axes()[axis].locate(points.coordinate(i, axis));
      point.cell[axis] = position.cell;
      point.fraction[axis] = position.fraction;
      group[axis] = position.cell >> kGroupBits;
      cell = cell << kGroupBits | (static_cast<std::uint64_t>(position.cell) & ((1u << kGroupBits) - 1));
      part = part << kGroupBits | static_cast<std::uint64_t>(position.fraction * (1 << kGroupBits));
    }
    const std::uint64_t hash = hash_cell<Dim>(group, 0) >> (64 - kHashBits);
    order[i] = {(hash << (Dim * kGroupBits) | cell) << (Dim * kGroupBits) | part, i};
  }
  sort_by_key(order, kHashBits + 2 * Dim * kGroupBits);
  std::vector<Located> located;
  located.reserve(points.size());
  for (const KeyedPoint& point : order) located.push_back(unsorted[point.point]);
  const auto group_differs = [](const Located& a, const Located& b) {
    for (int axis = 0; axis < Dim; ++axis) {
      if (a.cell[axis] >> kGroupBits != b.cell[axis] >> kGroupBits) return true;
    }
    return false;
  };
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
    range.first -= reach_;
    range.last += reach_;
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

template void SparseConvolution<1>::evaluate(const Points<1>&, const Samples<1>&) const;
template void SparseConvolution<2>::evaluate(const Points<2>&, const Samples<2>&) const;
template void SparseConvolution<3>::evaluate(const Points<3>&, const Samples<3>&) const;
template void SparseConvolution<4>::evaluate(const Points<4>&, const Samples<4>&) const;

}  // namespace solidnoise
