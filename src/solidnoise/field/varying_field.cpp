#include "solidnoise/field/varying_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/noise_views.h"

namespace solidnoise {
namespace {

// What a parameter's field says at some points; nothing where there is no field.
std::vector<float> sampled(const FieldPtr& field, const Points<3>& points) {
  if (!field) return {};
  std::vector<float> values(static_cast<std::size_t>(field->channels()) * points.size());
  field->evaluate(points, {values, {}});
  return values;
}

template <int Dim>
struct VaryingOctave {
  VaryingGaborNoise<Dim> noise;
  double ratio = 1.0;  // of its frequency to that of the first
  double amplitude = 1.0;
};

// Memory for samples of a noise of 3 or 4 dimensions, as those of space that others are like.
template <int Dim>
class OctaveSamples {
 public:
  explicit OctaveSamples(const Samples<3>& like)
      : size_(like.values.size()), memory_(size_ * (like.wants_gradient() ? 1 + Dim : 1)) {
    samples_.values = part(0);
    for (std::size_t axis = 0; like.wants_gradient() && axis < Dim; ++axis) {
      samples_.gradient[axis] = part(1 + axis);
    }
  }

  const Samples<Dim>& samples() const { return samples_; }

  void add(float amplitude, const Samples<3>& to) const {
    add(amplitude, samples_.values, to.values);
    for (std::size_t axis = 0; to.wants_gradient() && axis < 3; ++axis) {
      add(amplitude, samples_.gradient[axis], to.gradient[axis]);
    }
  }

 private:
  std::span<float> part(std::size_t i) { return std::span(memory_).subspan(i * size_, size_); }
  static void add(float amplitude, std::span<const float> from, std::span<float> to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += amplitude * from[i];
  }

  std::size_t size_;
  std::vector<float> memory_;
  Samples<Dim> samples_;
};

template <int Dim>
class VaryingField final : public PointwiseField {
 public:
  VaryingField(std::vector<VaryingOctave<Dim>> octaves, const NoiseView& view, KernelFields fields,
               const Band& constant_band)
      : octaves_(std::move(octaves)),
        view_(view),
        fields_(std::move(fields)),
        constant_band_(constant_band) {}

  bool has_gradient() const override { return true; }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    if (points.size() == 0) return;
    const std::vector<Vec<Dim>> positions = viewed(points.positions);
    const std::vector<float> frequencies = sampled(fields_.frequency.field, points);
    const std::vector<float> bandwidths = sampled(fields_.bandwidth.field, points);
    std::vector<float> directions = sampled(fields_.direction, points);
    if (fields_.direction) directions.resize(Dim * points.size(), 0.0f);  // no waves in time

    fill_with_zero(samples);
    std::vector<float> frequency(frequencies.size());
    const OctaveSamples<Dim> of_octave(samples);
    for (const VaryingOctave<Dim>& octave : octaves_) {
      std::ranges::transform(frequencies, frequency.begin(),
                             [&](float f) { return static_cast<float>(octave.ratio * f); });
      VaryingParameters<Dim> parameters;
      parameters.frequency = frequency;
      parameters.bandwidth = bandwidths;
      for (std::size_t axis = 0; fields_.direction && axis < Dim; ++axis) {
        parameters.direction[axis] = std::span(directions).subspan(axis * points.size(), points.size());
      }
      octave.noise.evaluate({positions}, parameters, of_octave.samples());
      of_octave.add(static_cast<float>(octave.amplitude), samples);
    }
  }

  std::optional<Statistics> statistics() const override {
    double variance = 0.0;
    double fourth_cumulant = 0.0;
    for (const VaryingOctave<Dim>& octave : octaves_) {
      variance += octave.amplitude * octave.amplitude;
      const double kurtosis = fields_.frequency || fields_.bandwidth ? octave.noise.varying_excess_kurtosis()
                                                                     : octave.noise.excess_kurtosis();
      fourth_cumulant += std::pow(octave.amplitude, 4) * kurtosis;
    }
    return Statistics{0.0, variance, fourth_cumulant / (variance * variance), band()};
  }

 private:
  std::vector<Vec<Dim>> viewed(std::span<const Vec<3>> positions) const {
    std::vector<Vec<Dim>> result;
    result.reserve(positions.size());
    for (const Vec<3>& position : positions) {
      if constexpr (Dim == 4) {
        result.emplace_back(position - view_.offset, view_.time);
      } else {
        result.push_back(position - view_.offset);
      }
    }
    return result;
  }

  Band band() const {
    if (!fields_.frequency) return constant_band_;
    const double constant = octaves_.front().noise.options().frequency / octaves_.front().ratio;
    return {constant_band_.lower * fields_.frequency.least / constant,
            constant_band_.upper * fields_.frequency.greatest / constant};
  }

  std::vector<VaryingOctave<Dim>> octaves_;
  NoiseView view_;
  KernelFields fields_;
  Band constant_band_;
};

// The options of an octave by itself.
VaryingGaborOptions varying_options(const NoiseRecipe& octave, const KernelFields& fields) {
  VaryingGaborOptions varying;
  varying.unit = fields.unit;
  const auto copy = [&](const auto& options) {
    varying.frequency = options.frequency;
    if (!fields.bandwidth) varying.bandwidth = options.bandwidth;
    varying.error = ErrorBudget(options.error).truncation;
    varying.bounds_gradient = options.bounds_gradient;
    varying.impulses = options.impulses;
    varying.impulses_process = options.impulses_process;
    varying.kurtosis = options.kurtosis;
    varying.seed = options.seed;
    varying.evolution = options.evolution;
    varying.filter = options.filter;
  };
  if (const auto* const oriented = std::get_if<OrientedGaborNoiseOptions>(&octave.noise)) {
    copy(*oriented);
    if (oriented->anisotropy == 0.0) return varying;
    varying.waves = GaborWaves::oriented;
    varying.direction = oriented->direction;
  } else {
    copy(std::get<GaborNoiseOptions>(octave.noise));
  }
  return varying;
}

// The band of the noise whose parameters are the recipe's everywhere.
Band constant_band(const NoiseRecipe& recipe, const NoiseView& view) {
  if (view.dims == 4) return slice(make_noise<4>(recipe), view.time)->band();
  return make_noise<3>(recipe)->band();
}

// The same where bandwidth and direction are those of the fields: from the narrowest to the widest, waves in
// space. Other directions have the same band.
Band constant_band(NoiseRecipe recipe, const NoiseView& view, const KernelFields& fields) {
  auto* const oriented = std::get_if<OrientedGaborNoiseOptions>(&recipe.noise);
  if (oriented && fields.direction) oriented->direction = {1.0, 0.0, 0.0, 0.0};
  const auto& bandwidth = fields.bandwidth;
  if (!bandwidth) return constant_band(recipe, view);
  const auto with_bandwidth = [&](double value) {
    NoiseRecipe result = recipe;
    std::visit(
        [&](auto& options) {
          if constexpr (requires { options.bandwidth; }) options.bandwidth = value;
        },
        result.noise);
    return constant_band(result, view);
  };
  const Band narrow = with_bandwidth(bandwidth.least);
  const Band wide = with_bandwidth(bandwidth.greatest);
  return {std::min(narrow.lower, wide.lower), std::max(narrow.upper, wide.upper)};
}

// Octaves from `first` on, with their amplitudes.
struct OctaveRange {
  int first = 0;
  std::vector<double> amplitudes;
};

template <int Dim>
FieldPtr make_octaves(const NoiseRecipe& recipe, const OctaveRange& range, const NoiseView& view,
                      const KernelFields& fields) {
  std::vector<VaryingOctave<Dim>> octaves;
  for (std::size_t i = 0; i < range.amplitudes.size(); ++i) {
    const int k = range.first + static_cast<int>(i);
    octaves.push_back({VaryingGaborNoise<Dim>(varying_options(octave_of(recipe, k), fields)),
                       recipe.fractal.frequency_ratio(k), range.amplitudes[i]});
  }
  const NoiseRecipe constant = octaves.size() == 1 ? octave_of(recipe, range.first) : recipe;
  return std::make_shared<VaryingField<Dim>>(std::move(octaves), view, fields,
                                             constant_band(constant, view, fields));
}

FieldPtr make_octaves(const NoiseRecipe& recipe, const OctaveRange& range, const NoiseView& view,
                      const KernelFields& fields) {
  recipe.validate();
  return view.dims == 4 ? make_octaves<4>(recipe, range, view, fields)
                        : make_octaves<3>(recipe, range, view, fields);
}

}  // namespace

FieldPtr make_varying_field(const NoiseRecipe& recipe, const NoiseView& view, const KernelFields& fields) {
  return make_octaves(recipe, {0, recipe.fractal.amplitudes()}, view, fields);
}

FieldPtr make_varying_octave(const NoiseRecipe& recipe, int k, const NoiseView& view,
                             const KernelFields& fields) {
  return make_octaves(recipe, {k, {1.0}}, view, fields);
}

}  // namespace solidnoise
