#include "solidnoise/noise/interpolation/interpolated_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/interpolation/coarse_samples.h"
#include "solidnoise/noise/interpolation/divide_down.h"
#include "solidnoise/noise/interpolation/interpolate_axis.h"

namespace solidnoise {
namespace {

// One axis of a lattice, interpolated: its samples from coarse ones.
struct InterpolatedAxis {
  int step = 1;
  int taps = 1;
  std::vector<float> weights;  // phase by phase

  explicit InterpolatedAxis(const AxisWeights& exact) : step(exact.shape().step), taps(exact.shape().taps) {
    for (int phase = 0; phase < step; ++phase) {
      for (const double weight : exact.of_phase(phase)) weights.push_back(static_cast<float>(weight));
    }
  }

  // The first and the last coarse sample that the samples from `begin` to `end` need.
  std::int64_t first(std::int64_t begin) const { return divide_down(begin, step) - (taps - 1) / 2; }
  std::int64_t last(std::int64_t end) const { return divide_down(end, step) + taps / 2; }

  AxisTaps taps_of(std::int64_t begin, int count) const {
    std::vector<std::size_t> first;
    std::vector<float> weight;
    for (std::int64_t i = begin; i < begin + count; ++i) {
      const std::int64_t coarse = divide_down(i, step);
      const auto phase = weights.begin() + static_cast<std::ptrdiff_t>((i - coarse * step) * taps);
      first.push_back(static_cast<std::size_t>(coarse - divide_down(begin, step)));
      weight.insert(weight.end(), phase, phase + taps);
    }
    return {taps, std::move(first), std::move(weight)};
  }
};

// A noise on one lattice, with the weights of its plan.
template <int Dim>
struct Interpolation {
  std::shared_ptr<const Noise<Dim>> noise;
  LatticeFrame<Dim> frame;
  std::vector<InterpolatedAxis> axes;
  mutable CoarseStore<Dim> store;

  Interpolation(std::shared_ptr<const Noise<Dim>> interpolated, const LatticeFrame<Dim>& lattice_frame,
                const std::vector<AxisWeights>& weights)
      : noise(std::move(interpolated)),
        frame(lattice_frame),
        axes(weights.begin(), weights.end()),
        store(noise, coarse_lattice()) {}

  bool applies_to(const Lattice<Dim>& lattice) const {
    return lattice.origin == frame.origin && lattice.step == frame.step;
  }

  // The coarse samples that samples from `begin` to `end` need; of ranges without end, as many as can be
  // counted.
  SampleRange<Dim> coarse_range(const Index<Dim>& begin, const Index<Dim>& end) const {
    SampleRange<Dim> range;
    for (int axis = 0; axis < Dim; ++axis) {
      const InterpolatedAxis& interpolated = axes[static_cast<std::size_t>(axis)];
      range.first[axis] = interpolated.first(begin[axis]);
      const std::int64_t count = interpolated.last(end[axis]) - range.first[axis] + 1;
      range.count[axis] = static_cast<int>(std::min<std::int64_t>(count, std::numeric_limits<int>::max()));
    }
    return range;
  }

 private:
  Lattice<Dim> coarse_lattice() const {
    Lattice<Dim> lattice{frame.origin, frame.step, {}, {}};
    for (int axis = 0; axis < Dim; ++axis) lattice.step[axis] *= axes[static_cast<std::size_t>(axis)].step;
    return lattice;
  }
};

template <int Dim>
class InterpolatedBlock final : public NoiseBlock<Dim> {
 public:
  InterpolatedBlock(std::shared_ptr<const Interpolation<Dim>> interpolation, const Box<Dim>& box)
      : interpolation_(std::move(interpolation)), box_(box) {}

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    const bool applies = interpolation_->applies_to(lattice);
    if (samples.wants_gradient() || !applies) {
      if (!direct_) direct_ = interpolation_->noise->block(box_);
      direct_->evaluate(lattice, samples);
    }
    if (!applies) return;
    if (!coarse_) gather_coarse();
    interpolate(lattice, samples.values);
  }

 private:
  // Those that all samples in the box may need.
  void gather_coarse() const {
    const LatticeFrame<Dim>& frame = interpolation_->frame;
    constexpr double kTolerance = 1e-6;  // samples: what the box's corners may be rounded by
    Index<Dim> begin;
    Index<Dim> end;
    for (int axis = 0; axis < Dim; ++axis) {
      const double lower = (box_.lower[axis] - frame.origin[axis]) / frame.step[axis];
      const double upper = (box_.upper[axis] - frame.origin[axis]) / frame.step[axis];
      begin[axis] = static_cast<std::int64_t>(std::floor(lower + kTolerance));
      end[axis] = static_cast<std::int64_t>(std::ceil(upper - kTolerance));
    }
    coarse_.emplace(interpolation_->store, interpolation_->coarse_range(begin, end));
  }

  // From the last axis to the first: the arrays in between are then the smallest where each value costs most.
  void interpolate(const Lattice<Dim>& lattice, std::span<float> values) const {
    Index<Dim> end;
    for (int axis = 0; axis < Dim; ++axis) end[axis] = lattice.first[axis] + lattice.count[axis] - 1;
    const SampleRange<Dim> range = interpolation_->coarse_range(lattice.first, end);
    const auto taps = [&](int axis) -> const AxisTaps& {
      return taps_of(axis, lattice.first[axis], lattice.count[axis]);
    };
    AxisShape shape{range.size() / static_cast<std::size_t>(range.count[Dim - 1]), 1,
                    static_cast<std::size_t>(lattice.count[Dim - 1])};
    const SampleRows coarse = coarse_->rows(range);
    float* out = room_in(to_, shape.outer * shape.inner);
    interpolate_last_axis(taps(Dim - 1), coarse, out);
    for (int axis = Dim - 2; axis >= 0; --axis) {
      const float* const in = out;
      std::swap(from_, to_);
      const auto count = static_cast<std::size_t>(lattice.count[axis]);
      shape.in = static_cast<std::size_t>(range.count[axis]);
      shape.outer /= shape.in;
      out = axis > 0 ? room_in(to_, shape.outer * count * shape.inner) : values.data();
      interpolate_axis(taps(axis), shape, in, out);
      shape.inner *= count;
    }
  }

  static float* room_in(std::vector<float>& buffer, std::size_t size) {
    if (buffer.size() < size) buffer.resize(size);
    return buffer.data();
  }

  // Those of an axis are the same for all blocks of lattices that begin at one phase.
  const AxisTaps& taps_of(int axis, std::int64_t begin, int count) const {
    const InterpolatedAxis& interpolated = interpolation_->axes[static_cast<std::size_t>(axis)];
    const std::int64_t phase = begin - divide_down(begin, interpolated.step) * interpolated.step;
    auto& known = taps_[static_cast<std::size_t>(axis)];
    const auto found = known.try_emplace({phase, count}, nullptr).first;
    if (!found->second) found->second = std::make_unique<AxisTaps>(interpolated.taps_of(phase, count));
    return *found->second;
  }

  std::shared_ptr<const Interpolation<Dim>> interpolation_;
  Box<Dim> box_;
  // Made when they are first needed: a block belongs to one thread.
  mutable std::unique_ptr<NoiseBlock<Dim>> direct_;
  mutable std::optional<CoarseSamples<Dim>> coarse_;
  mutable std::array<std::map<std::pair<std::int64_t, int>, std::unique_ptr<AxisTaps>>, Dim> taps_;
  mutable std::vector<float> from_;
  mutable std::vector<float> to_;
};

template <int Dim>
class InterpolatedNoise final : public Noise<Dim> {
 public:
  explicit InterpolatedNoise(std::shared_ptr<const Interpolation<Dim>> interpolation)
      : interpolation_(std::move(interpolation)), noise_(*interpolation_->noise) {}

  using Noise<Dim>::evaluate;
  std::unique_ptr<NoiseBlock<Dim>> block(const Box<Dim>& box) const override {
    return std::make_unique<InterpolatedBlock<Dim>>(interpolation_, box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    noise_.evaluate(points, samples);
  }
  double variance() const override { return noise_.variance(); }
  Vec<Dim> gradient_variance() const override { return noise_.gradient_variance(); }
  double power_spectrum(const Vec<Dim>& frequency) const override { return noise_.power_spectrum(frequency); }
  double excess_kurtosis() const override { return noise_.excess_kurtosis(); }
  typename Noise<Dim>::Band band() const override { return noise_.band(); }
  WaveMixture<Dim> waves() const override { return noise_.waves(); }

 private:
  std::shared_ptr<const Interpolation<Dim>> interpolation_;
  const Noise<Dim>& noise_;
};

template <int Dim>
std::shared_ptr<const Noise<Dim>> follow_plan(std::shared_ptr<const Noise<Dim>> noise,
                                              const LatticeFrame<Dim>& frame,
                                              const InterpolationPlan<Dim>& plan) {
  if (plan.direct()) return noise;
  const auto weights = interpolation_weights<Dim>(noise->waves(), frame.step, plan);
  return std::make_shared<InterpolatedNoise<Dim>>(
      std::make_shared<const Interpolation<Dim>>(std::move(noise), frame, weights));
}

}  // namespace

template <int Dim>
std::shared_ptr<const Noise<Dim>> interpolate(std::shared_ptr<const Noise<Dim>> noise,
                                              const LatticeFrame<Dim>& frame, double error) {
  const auto plans = plan_interpolation<Dim>(*noise, frame.step, error);
  const auto parts = noise->parts();
  if (parts.empty()) return follow_plan<Dim>(noise, frame, plans.front());
  if (std::all_of(plans.begin(), plans.end(), [](const auto& plan) { return plan.direct(); })) return noise;
  std::vector<typename FractalNoise<Dim>::Octave> octaves;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    octaves.push_back({follow_plan<Dim>(parts[i].noise, frame, plans[i]), parts[i].amplitude});
  }
  return std::make_shared<FractalNoise<Dim>>(std::move(octaves));
}

template std::shared_ptr<const Noise<2>> interpolate<2>(std::shared_ptr<const Noise<2>>,
                                                        const LatticeFrame<2>&, double);
template std::shared_ptr<const Noise<3>> interpolate<3>(std::shared_ptr<const Noise<3>>,
                                                        const LatticeFrame<3>&, double);

}  // namespace solidnoise
