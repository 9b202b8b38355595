#include "solidnoise/noise/interpolation/point_interpolation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <glm/common.hpp>

namespace solidnoise {
namespace {

PointWeights tabulate(const WaveMixture<3>& waves, const Vec<3>& step, int taps) {
  const LatticeWeights exact = point_weights(waves, step, PointWeights::kPlaces, taps);
  PointWeights weights{taps, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int place = 0; place <= PointWeights::kPlaces; ++place) {
      std::array<float, PointWeights::kMostTaps> row{};
      if (place == PointWeights::kPlaces) {
        row[static_cast<std::size_t>(taps / 2)] = 1.0f;  // the next sample
      } else {
        std::ranges::copy(exact.values[axis].of_phase(place), row.begin());
      }
      weights.of_axis[axis].push_back(row);
    }
  }
  return weights;
}

// The largest whole numbers that are no more.
Index<3> sample_before(const Vec<3>& at) {
  Index<3> before;
  for (int axis = 0; axis < 3; ++axis) {
    before[axis] = static_cast<std::int64_t>(at[axis]);
    if (at[axis] < static_cast<double>(before[axis])) --before[axis];
  }
  return before;
}

}  // namespace

PointInterpolation::PointInterpolation(const std::shared_ptr<const Noise<3>>& noise,
                                       const LatticeFrame<3>& frame, const PointPlan& plan)
    : origin_(frame.origin),
      step_(plan.spacing * frame.step),
      per_step_(1.0 / step_),
      weights_(tabulate(noise->waves(), step_, plan.taps)),
      store_(noise, {origin_, step_, {}, {}}) {}

void PointInterpolation::evaluate(std::span<const Vec<3>> positions, std::span<float> values) const {
  constexpr std::size_t kTogether = 32768;  // points, whose samples are side by side
  for (std::size_t first = 0; first < positions.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, positions.size() - first);
    evaluate_some(positions.subspan(first, count), values.data() + first);
  }
}

// Points that are too far from each other are halved. They are placed in runs that stay in the processor's
// caches.
void PointInterpolation::evaluate_some(std::span<const Vec<3>> positions, float* values) const {
  constexpr std::size_t kRun = 256;
  constexpr double kMostSamples = 0x1p24;
  Vec<3> least = positions.front();
  Vec<3> most = positions.front();
  for (const Vec<3>& position : positions) {
    least = glm::min(least, position);
    most = glm::max(most, position);
  }
  const Index<3> lowest = sample_before(steps_to(least));
  const Index<3> highest = sample_before(steps_to(most));
  SampleRange<3> range;
  double samples = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    samples *= static_cast<double>(highest[axis] - lowest[axis] + weights_.taps);
    range.first[axis] = lowest[axis] - (weights_.taps / 2 - 1);
    range.count[axis] = static_cast<int>(highest[axis] - lowest[axis]) + weights_.taps;
  }
  if (samples > kMostSamples && positions.size() > 1) {
    const std::size_t half = positions.size() / 2;
    evaluate_some(positions.first(half), values);
    evaluate_some(positions.subspan(half), values + half);
    return;
  }
  CoarseSamples<3> coarse(store_, range);
  const SampleRows rows = coarse.rows(range);

  std::array<PlacedPoint, kRun> points;
  for (std::size_t first = 0; first < positions.size(); first += kRun) {
    const std::size_t count = std::min(kRun, positions.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec<3> at = steps_to(positions[first + i]);
      const Index<3> before = sample_before(at);
      for (int axis = 0; axis < 3; ++axis) {
        points[i].place[static_cast<std::size_t>(axis)] =
            static_cast<float>((at[axis] - static_cast<double>(before[axis])) * PointWeights::kPlaces);
      }
      const Index<3> from = before - lowest;
      points[i].first = static_cast<std::size_t>(from.x) * rows.slab_stride +
                        static_cast<std::size_t>(from.y) * rows.row_stride + static_cast<std::size_t>(from.z);
    }
    interpolate_points(weights_, rows, std::span(points).first(count), values + first);
  }
}

}  // namespace solidnoise
