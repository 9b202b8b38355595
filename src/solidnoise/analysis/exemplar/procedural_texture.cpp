#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/core/lattice.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"

namespace solidnoise {
namespace {

constexpr int kStrip = 32;  // columns that are evaluated together

template <int Dim>
DenseField<2> evaluate(const SpectrumNoise<Dim>& noise, const glm::ivec2& count, const Vec<2>& step,
                       const Vec<3>& origin) {
  DenseField<2> field(count, step);
  const int strips = (count.x + kStrip - 1) / kStrip;
  tbb::parallel_for(0, strips, [&](int strip) {
    Lattice<Dim> lattice;
    lattice.count[0] = std::min(kStrip, count.x - strip * kStrip);
    lattice.count[1] = count.y;
    lattice.first[0] = strip * kStrip;
    for (int axis = 0; axis < Dim; ++axis) {
      lattice.origin[axis] = origin[axis];
      if (axis < 2) lattice.step[axis] = step[axis];
    }
    const std::size_t first = static_cast<std::size_t>(strip * kStrip) * static_cast<std::size_t>(count.y);
    Samples<Dim> samples;
    samples.values = {field.values.data() + first, lattice.size()};
    noise.block(lattice.bounds())->evaluate(lattice, samples);
  });
  return field;
}

}  // namespace

Exemplar<2> procedural_texture(const ExemplarModel& model, const glm::ivec2& count, const Vec<2>& step,
                               const Vec<3>& origin, std::uint64_t seed) {
  std::vector<DenseField<2>> channels;
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    SpectrumNoiseOptions options;
    options.model = model;
    options.channel = static_cast<int>(k);
    options.frequency = model.principal_frequency();  // as in the exemplar
    options.seed = derive_seed(seed, k);
    channels.push_back(model.channels[k].dimensions == 2
                           ? evaluate(SpectrumNoise<2>(options), count, step, origin)
                           : evaluate(SpectrumNoise<3>(options), count, step, origin));
    const auto deviation = static_cast<float>(std::sqrt(model.channels[k].variance()));
    for (float& value : channels.back().values) value *= deviation;
  }
  return compose(model, channels);
}

}  // namespace solidnoise
