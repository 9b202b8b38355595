#include "solidnoise/analysis/exemplar/prepare_exemplars.h"

#include <array>
#include <cstddef>

namespace solidnoise {

void make_grey(Exemplar<2>& exemplar) {
  if (exemplar.channels.size() == 1) return;
  constexpr std::array kWeights{0.2126f, 0.7152f, 0.0722f};
  DenseField<2> grey(exemplar.shape().count, exemplar.shape().step);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
      grey.values[i] += kWeights[c] * exemplar.channels[c].values[i];
    }
  }
  exemplar.channels = {grey};
}

void agree_on_channels(std::vector<Exemplar<2>>& exemplars) {
  bool color = false;
  for (const Exemplar<2>& exemplar : exemplars) color = color || exemplar.channels.size() == 3;
  if (!color) return;
  for (Exemplar<2>& exemplar : exemplars) exemplar.channels.resize(3, exemplar.channels.front());
}

}  // namespace solidnoise
