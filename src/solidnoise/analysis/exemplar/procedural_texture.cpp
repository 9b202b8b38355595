#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/core/lattice.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/plane_noise.h"

namespace solidnoise {
namespace {

constexpr int kStrip = 128;  // columns that are evaluated together

// The noise on the plane z = origin.z, and where its lattice begins.
template <int Dim>
std::pair<std::shared_ptr<const Noise<2>>, Vec<2>> plane_of(const SpectrumNoiseOptions& options,
                                                            const Vec<3>& origin) {
  auto noise = std::make_shared<const SpectrumNoise<Dim>>(with_truncation_share(options));
  if constexpr (Dim == 2) {
    return {noise, Vec<2>(origin)};
  } else {
    return {on_plane(noise, {.origin = origin}), Vec<2>(0.0)};
  }
}

DenseField<2> evaluate(const SpectrumNoiseOptions& options, const glm::ivec2& count, const Vec<2>& step,
                       const Vec<3>& origin) {
  const bool flat = options.model.channels[static_cast<std::size_t>(options.channel)].dimensions == 2;
  const auto [noise, first] = flat ? plane_of<2>(options, origin) : plane_of<3>(options, origin);
  const auto interpolated = interpolate<2>(noise, {first, step}, ErrorBudget(options.error).interpolation);
  DenseField<2> field(count, step);
  const int strips = (count.x + kStrip - 1) / kStrip;
  tbb::parallel_for(0, strips, [&](int strip) {
    const int begin = strip * kStrip;
    const Lattice<2> lattice{first, step, {begin, 0}, {std::min(kStrip, count.x - begin), count.y}};
    const std::size_t offset = static_cast<std::size_t>(begin) * static_cast<std::size_t>(count.y);
    const std::span<float> values(field.values.data() + offset, lattice.size());
    interpolated->block(lattice.bounds())->evaluate(lattice, Samples<2>{values, {}});
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
    channels.push_back(evaluate(options, count, step, origin));
    const auto deviation = static_cast<float>(std::sqrt(model.channels[k].variance()));
    for (float& value : channels.back().values) value *= deviation;
  }
  return compose(model, channels);
}

}  // namespace solidnoise
