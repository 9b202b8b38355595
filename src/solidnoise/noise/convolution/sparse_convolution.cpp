#include "solidnoise/noise/convolution/sparse_convolution.h"

#include <cmath>

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

}  // namespace solidnoise
