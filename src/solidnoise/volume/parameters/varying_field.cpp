#include "solidnoise/volume/parameters/varying_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/slice_noise.h"
#include "solidnoise/volume/parameters/lattice_positions.h"

namespace solidnoise {
namespace {

// Positions as offsets from the first of them. Where there is a quantum, a power of two, coordinates are
// rounded to multiples of it, and the offsets are exact.
template <int Dim>
class GatheredPoints {
 public:
  GatheredPoints(std::span<const Vec<3>> positions, const NoiseView& view, const Vec<3>& quantum) {
    points_.count = positions.size();
    for (int axis = 0; axis < 3; ++axis) {
      const double q = quantum[axis];
      const auto coordinate = [&](const Vec<3>& position) {
        const double moved = position[axis] - view.offset[axis];
        return q > 0.0 ? q * std::floor(moved / q + 0.5) : moved;
      };
      const double origin = coordinate(positions.front());
      auto& offset = offset_[static_cast<std::size_t>(axis)];
      offset.reserve(positions.size());
      for (const Vec<3>& position : positions) {
        offset.push_back(static_cast<float>(coordinate(position) - origin));
      }
      points_.origin[axis] = origin;
    }
    if constexpr (Dim == 4) {
      points_.origin[3] = view.time;
      offset_[3].assign(positions.size(), 0.0f);
    }
    for (std::size_t axis = 0; axis < Dim; ++axis) points_.offset[axis] = offset_[axis].data();
  }

  const Points<Dim>& points() const { return points_; }

 private:
  Points<Dim> points_;
  std::array<std::vector<float>, Dim> offset_;
};

// What the fields say at some positions; empty where there is no field.
template <int Dim>
struct SampledParameters {
  std::vector<float> frequency;
  std::vector<float> bandwidth;
  std::array<std::vector<float>, Dim> direction;

  SampledParameters(const ParameterFields& fields, std::span<const Vec<3>> positions) {
    if (const auto& field = fields.frequency()) {
      frequency.resize(positions.size());
      field->sample(positions, frequency);
    }
    if (const auto& field = fields.bandwidth()) {
      bandwidth.resize(positions.size());
      field->sample(positions, bandwidth);
    }
    if (const auto& field = fields.direction()) {
      for (auto& component : direction) component.assign(positions.size(), 0.0f);
      field->sample(positions, {direction[0], direction[1], direction[2]});
    }
  }
};

template <int Dim>
struct VaryingOctave {
  VaryingGaborNoise<Dim> noise;
  double ratio = 1.0;  // of its frequency to that of the first
  double amplitude = 1.0;
};

class VaryingBlock final : public FieldBlock {
 public:
  using EvaluateAt =
      std::function<void(std::span<const Vec<3>> positions, const Vec<3>& quantum, std::span<float> values)>;
  explicit VaryingBlock(EvaluateAt evaluate_at) : evaluate_at_(std::move(evaluate_at)) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    evaluate_all({&lattice, 1}, values);
  }

  void evaluate_all(std::span<const Lattice<3>> lattices, std::span<float> values) const override {
    constexpr int kQuantaLog2 = 16;  // per voxel; single precision then holds 2^8 voxels
    if (lattices.empty()) return;
    Vec<3> quantum;
    for (int axis = 0; axis < 3; ++axis) {
      quantum[axis] = std::ldexp(1.0, std::ilogb(lattices.front().step[axis]) - kQuantaLog2);
    }
    std::vector<Vec<3>> positions;
    for (const Lattice<3>& lattice : lattices) append_positions(lattice, positions);
    evaluate_at_(positions, quantum, values);
  }

 private:
  EvaluateAt evaluate_at_;
};

template <int Dim>
class VaryingOctaves final : public VaryingField {
 public:
  VaryingOctaves(std::vector<VaryingOctave<Dim>> octaves, const NoiseView& view,
                 std::shared_ptr<const ParameterFields> fields, const Noise<3>::Band& constant_band)
      : octaves_(std::move(octaves)),
        view_(view),
        fields_(std::move(fields)),
        constant_band_(constant_band) {}

  std::unique_ptr<FieldBlock> block(const Box<3>&) const override {
    return std::make_unique<VaryingBlock>(
        [this](std::span<const Vec<3>> positions, const Vec<3>& quantum, std::span<float> values) {
          evaluate_at(positions, quantum, values);
        });
  }

  void evaluate(std::span<const Vec<3>> positions, std::span<float> values) const override {
    evaluate_at(positions, Vec<3>(0.0), values);
  }

  double variance() const override {
    double sum = 0.0;
    for (const VaryingOctave<Dim>& octave : octaves_) sum += octave.amplitude * octave.amplitude;
    return sum;
  }

  double excess_kurtosis() const override {
    double sum = 0.0;
    for (const VaryingOctave<Dim>& octave : octaves_) {
      sum += std::pow(octave.amplitude, 4) * octave.noise.excess_kurtosis();
    }
    return sum / (variance() * variance());
  }

  Noise<3>::Band band() const override {
    const auto& frequency = fields_->frequency();
    if (!frequency) return constant_band_;
    const double constant = octaves_.front().noise.options().frequency / octaves_.front().ratio;
    return {constant_band_.lower * frequency->least() / constant,
            constant_band_.upper * frequency->greatest() / constant};
  }

 private:
  void evaluate_at(std::span<const Vec<3>> positions, const Vec<3>& quantum, std::span<float> values) const {
    if (positions.empty()) return;
    const GatheredPoints<Dim> gathered(positions, view_, quantum);
    const SampledParameters<Dim> sampled(*fields_, positions);
    std::fill(values.begin(), values.end(), 0.0f);
    std::vector<float> frequency(sampled.frequency.size());
    std::vector<float> of_octave(positions.size());
    for (const VaryingOctave<Dim>& octave : octaves_) {
      std::transform(sampled.frequency.begin(), sampled.frequency.end(), frequency.begin(),
                     [&](float f) { return static_cast<float>(octave.ratio * f); });
      VaryingParameters<Dim> parameters;
      parameters.frequency = frequency;
      parameters.bandwidth = sampled.bandwidth;
      for (std::size_t axis = 0; axis < Dim; ++axis) parameters.direction[axis] = sampled.direction[axis];
      octave.noise.evaluate(gathered.points(), parameters, of_octave);
      const auto amplitude = static_cast<float>(octave.amplitude);
      for (std::size_t i = 0; i < positions.size(); ++i) values[i] += amplitude * of_octave[i];
    }
  }

  std::vector<VaryingOctave<Dim>> octaves_;
  NoiseView view_;
  std::shared_ptr<const ParameterFields> fields_;
  Noise<3>::Band constant_band_;
};

// The options of an octave by itself.
VaryingGaborOptions varying_options(const NoiseRecipe& octave, const ParameterFields& fields) {
  VaryingGaborOptions varying;
  const auto copy = [&](const auto& options) {
    varying.frequency = options.frequency;
    if (!fields.bandwidth()) varying.bandwidth = options.bandwidth;
    varying.error = options.error;
    varying.impulses = options.impulses;
    varying.seed = options.seed;
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
Noise<3>::Band constant_band(const NoiseRecipe& recipe, const NoiseView& view) {
  if (view.dims == 4) return slice(make_noise<4>(recipe), view.time)->band();
  return make_noise<3>(recipe)->band();
}

// The same where bandwidth and direction are those of the fields: from the narrowest to the widest, waves in
// space. Other directions have the same band.
Noise<3>::Band constant_band(NoiseRecipe recipe, const NoiseView& view, const ParameterFields& fields) {
  auto* const oriented = std::get_if<OrientedGaborNoiseOptions>(&recipe.noise);
  if (oriented && fields.direction()) oriented->direction = {1.0, 0.0, 0.0, 0.0};
  const auto& bandwidth = fields.bandwidth();
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
  const Noise<3>::Band narrow = with_bandwidth(bandwidth->least());
  const Noise<3>::Band wide = with_bandwidth(bandwidth->greatest());
  return {std::min(narrow.lower, wide.lower), std::max(narrow.upper, wide.upper)};
}

struct OctaveRange {
  int first = 0;
  int count = 1;
  double scale = 1.0;  // amplitude of the first
};

template <int Dim>
std::shared_ptr<const VaryingField> make_octaves(const NoiseRecipe& recipe, const OctaveRange& range,
                                                 const NoiseView& view,
                                                 std::shared_ptr<const ParameterFields> fields) {
  std::vector<VaryingOctave<Dim>> octaves;
  for (int i = 0; i < range.count; ++i) {
    const int k = range.first + i;
    octaves.push_back({VaryingGaborNoise<Dim>(varying_options(octave_of(recipe, k), *fields)),
                       std::pow(recipe.fractal.lacunarity, k),
                       range.scale * std::pow(recipe.fractal.gain, i)});
  }
  const NoiseRecipe constant = range.count == 1 ? octave_of(recipe, range.first) : recipe;
  const Noise<3>::Band band = constant_band(constant, view, *fields);
  return std::make_shared<VaryingOctaves<Dim>>(std::move(octaves), view, std::move(fields), band);
}

std::shared_ptr<const VaryingField> make_octaves(const NoiseRecipe& recipe, const OctaveRange& range,
                                                 const NoiseView& view,
                                                 std::shared_ptr<const ParameterFields> fields) {
  recipe.validate();
  fields->grids().validate(recipe);
  return view.dims == 4 ? make_octaves<4>(recipe, range, view, std::move(fields))
                        : make_octaves<3>(recipe, range, view, std::move(fields));
}

}  // namespace

std::shared_ptr<const VaryingField> make_varying_field(const NoiseRecipe& recipe, const NoiseView& view,
                                                       std::shared_ptr<const ParameterFields> fields) {
  const FractalOptions& fractal = recipe.fractal;
  double power = 0.0;
  for (int k = 0; k < fractal.octaves; ++k) power += std::pow(fractal.gain, 2 * k);
  const double scale = fractal.renormalize ? 1.0 / std::sqrt(power) : 1.0;
  return make_octaves(recipe, {0, fractal.octaves, scale}, view, std::move(fields));
}

std::shared_ptr<const VaryingField> make_varying_octave(const NoiseRecipe& recipe, int k,
                                                        const NoiseView& view,
                                                        std::shared_ptr<const ParameterFields> fields) {
  return make_octaves(recipe, {k, 1, 1.0}, view, std::move(fields));
}

}  // namespace solidnoise
