#include "solidnoise/analysis/kernel_slice.h"

#include <variant>

#include "solidnoise/noise/registry/noise_entries.h"

namespace solidnoise {

DenseField<2> kernel_slice(const NoiseRecipe& recipe, int dims) {
  const KernelSlice slice = std::visit(
      [&]<typename Options>(const Options& options) {
        using Entry = NoiseEntry<Options>;
        return dims == 3 ? Entry::template slice<3>(options) : Entry::template slice<4>(options);
      },
      recipe.noise);
  constexpr int kSide = 129;  // samples; odd, so that one is in the middle
  const double step = 2.0 * slice.half_width / (kSide - 1);
  DenseField<2> field({kSide, kSide}, {step, step});
  float* sample = field.values.data();
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      *sample++ = static_cast<float>(slice.value(step * i - slice.half_width, step * j - slice.half_width));
    }
  }
  return field;
}

}  // namespace solidnoise
