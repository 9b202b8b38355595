#include "solidnoise/analysis/exemplar/frequency_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solidnoise/analysis/exemplar/balance_rings.h"
#include "solidnoise/analysis/exemplar/exemplar_patches.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/analysis/fft.h"
#include "solidnoise/analysis/periodogram.h"

namespace solidnoise {
namespace {

using Complex = std::complex<double>;

constexpr int kLargestBlock = 512;   // samples along an axis
constexpr double kWidth = 0.05;      // cycles per sample
constexpr double kLeastSteps = 4.0;  // of a block's frequencies, to which the window spreads each, in a ring

// A window that begins in the middle, or at the end as usual.
std::vector<double> shifted_window(int count, bool shifted) {
  std::vector<double> window = window_values(Window::hann, count);
  if (shifted) std::rotate(window.begin(), window.begin() + count / 2, window.end());
  return window;
}

std::vector<Complex> windowed_transform(const DenseField<2>& field, const std::array<bool, 2>& shifted) {
  const std::vector<double> rows = shifted_window(field.count.x, shifted[0]);
  const std::vector<double> columns = shifted_window(field.count.y, shifted[1]);
  std::vector<double> values;
  values.reserve(field.size());
  for (const double row : rows) {
    for (const double column : columns) values.push_back(row * column * field.values[values.size()]);
  }
  return fft_of_real(values, std::vector<int>{field.count.x, field.count.y});
}

double energy_of(int count) {
  double sum = 0.0;
  for (const double value : window_values(Window::hann, count)) sum += value * value;
  return sum;
}

}  // namespace

std::size_t FrequencyRings::ring_of(Vec<2> frequency) const {
  frequency -= glm::round(frequency * step) / step;
  return std::min(static_cast<std::size_t>(glm::length(frequency) / width), count() - 1);
}

FrequencyRings frequency_rings(std::span<const Exemplar<2>> exemplars, const ExemplarChannels& channels,
                               Progress* progress) {
  PowerSpectrum<2> block;  // for its frequencies
  block.step = exemplars.front().shape().step;
  block.count = glm::ivec2(kLargestBlock);
  for (const Exemplar<2>& exemplar : exemplars) block.count = glm::min(block.count, exemplar.shape().count);
  for (int axis = 0; axis < 2; ++axis) block.count[axis] = fast_count(block.count[axis]);

  FrequencyRings rings;
  rings.step = block.step;
  const double coarsest = std::max(block.frequency_step(0), block.frequency_step(1));
  rings.width = std::max(kWidth / std::max(block.step.x, block.step.y), kLeastSteps * coarsest);
  for (int axis = 0; axis < 2; ++axis) {
    // The mean square of the derivative of the window over that of itself, in cycles: 1 / (3 length^2).
    rings.blur[axis] = block.frequency_step(axis) * block.frequency_step(axis) / 3.0;
  }
  const double corner = 0.5 * glm::length(1.0 / block.step);
  rings.variances.assign(channels.axes.size(),
                         std::vector<double>(static_cast<std::size_t>(std::ceil(corner / rings.width))));

  const std::size_t colors = exemplars.front().channels.size();
  std::vector cross(rings.count(), std::vector<double>(colors * colors));
  const double size = static_cast<double>(block.count.x) * block.count.y;
  const double energy = size * energy_of(block.count.x) * energy_of(block.count.y);
  double windows = 0.0;
  const auto add = [&](const std::vector<DenseField<2>>& fields, const std::array<bool, 2>& shifted) {
    ++windows;
    std::vector<std::vector<Complex>> transforms;
    for (const DenseField<2>& field : fields) transforms.push_back(windowed_transform(field, shifted));
    for (std::size_t p = 0; p < transforms.front().size(); ++p) {
      std::vector<double>& ring = cross[rings.ring_of(block.frequency(p))];
      for (std::size_t i = 0; i < colors; ++i) {
        for (std::size_t j = 0; j < colors; ++j)
          ring[i * colors + j] += (std::conj(transforms[i][p]) * transforms[j][p]).real() / energy;
      }
    }
  };
  for_each_patch(exemplars, block.count, progress, [&](std::vector<DenseField<2>>& fields) {
    for (std::size_t i = 0; i < colors; ++i) {
      const auto mean = static_cast<float>(channels.mean[static_cast<int>(i)]);
      for (float& value : fields[i].values) value -= mean;
      fields[i] = periodic_component(fields[i]);
    }
    for (const bool x : {false, true}) {
      for (const bool y : {false, true}) add(fields, {x, y});
    }
  });
  for (std::vector<double>& ring : cross) {
    for (double& power : ring) power /= windows;
  }
  rings.variances = balance_rings(cross, channels);
  return rings;
}

}  // namespace solidnoise
