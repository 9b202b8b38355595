#include "solidnoise/mesh/surface_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

#include "solidnoise/core/random.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/graded_field.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"
#include "solidnoise/noise/noise_views.h"

namespace solidnoise {
namespace {

std::array<std::span<const float>, 3> spans_of(const Components& components) {
  return {components[0], components[1], components[2]};
}

// What the fields of a kernel say at some points; empty where there is no field.
struct SampledKernel {
  std::vector<float> frequency;
  std::vector<float> bandwidth;
  Components direction;

  SampledKernel(const KernelFields& fields, const Points<3>& points) {
    if (fields.frequency) frequency = sample(*fields.frequency.field, points);
    if (fields.bandwidth) bandwidth = sample(*fields.bandwidth.field, points);
    if (!fields.direction) return;
    const std::vector<float> all = sample(*fields.direction, points);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(axis * points.size());
      direction[axis].assign(first, first + static_cast<std::ptrdiff_t>(points.size()));
    }
  }

  VaryingParameters<3> parameters() const { return {frequency, bandwidth, {}, spans_of(direction)}; }

 private:
  static std::vector<float> sample(const Field<3>& field, const Points<3>& points) {
    std::vector<float> values(static_cast<std::size_t>(field.channels()) * points.size());
    field.evaluate(points, {values, {}});
    return values;
  }
};

void evaluate_at(const SurfaceGaborNoise& noise, const SurfacePoints& points, const SampledKernel& kernel,
                 const Samples<3>& samples) {
  noise.evaluate(points, kernel.parameters(), samples);
}
void evaluate_at(const SurfaceSpectrumNoise& noise, const SurfacePoints& points, const SampledKernel& kernel,
                 const Samples<3>& samples) {
  noise.evaluate(points, spans_of(kernel.direction), samples);
}
void evaluate_at(const ProjectedGradientNoise& noise, const SurfacePoints& points, const SampledKernel&,
                 const Samples<3>& samples) {
  noise.evaluate(points, samples);
}

// One octave of a noise of the tangent plane, of unit variance.
template <typename Noise>
class TangentField final : public PointwiseField {
 public:
  TangentField(Noise noise, KernelFields fields) : noise_(std::move(noise)), fields_(std::move(fields)) {}

  bool has_gradient() const override { return true; }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    if (points.normals.size() != points.size()) {
      throw std::invalid_argument("a noise of the tangent plane needs the normals of a surface");
    }
    const Components normals = components_of(points.normals);
    evaluate_at(noise_, SurfacePoints{points, spans_of(normals)}, SampledKernel(fields_, points), samples);
  }

  // Of the noise whose parameters are the options' everywhere. The kurtosis of projected noise is not known.
  std::optional<Statistics> statistics() const override {
    const auto band = noise_.band();
    Statistics statistics{0.0, 1.0, 0.0, {band.lower, band.upper}};
    if constexpr (requires { noise_.variance(); }) statistics.variance = noise_.variance();
    if constexpr (requires { noise_.excess_kurtosis(); })
      statistics.excess_kurtosis = noise_.excess_kurtosis();
    if constexpr (requires { noise_.varying_excess_kurtosis(); }) {
      if (fields_.frequency || fields_.bandwidth)
        statistics.excess_kurtosis = noise_.varying_excess_kurtosis();
    }
    return statistics;
  }

 private:
  Noise noise_;
  KernelFields fields_;
};

template <typename Noise>
FieldPtr tangent_field(Noise noise, const KernelFields& fields) {
  return std::make_shared<TangentField<Noise>>(std::move(noise), fields);
}

// The options that all noises by example or of Gabor kernels have.
template <typename Options>
Options common_options(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  Options options;
  options.frequency = kernel.frequency;
  options.seed = recipe.seed;
  if constexpr (requires { options.error; }) {
    options.error = recipe.error;
    options.impulses = recipe.impulses;
    options.impulses_process = recipe.impulses_process;
  }
  if constexpr (requires { options.kurtosis; }) options.kurtosis = recipe.kurtosis;
  if constexpr (requires { options.bounds_gradient; }) options.bounds_gradient = kernel.bounds_gradient;
  if constexpr (requires { options.evolution; }) {
    if (recipe.dims == 3) options.evolution = recipe.evolution();
  }
  if constexpr (requires { options.period; }) {
    if (recipe.dims == 4) options.period[3] = recipe.loop;
  }
  return options;
}

// The noise of space that the recipe is of, if it is of one.
std::optional<NoiseRecipe> solid_recipe(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  switch (recipe.kind) {
    case SurfaceNoiseKind::solid: {
      auto options = common_options<GaborNoiseOptions>(recipe, kernel);
      options.bandwidth = kernel.bandwidth;
      if (may_filter(recipe)) options.filter = kernel.filter;
      return NoiseRecipe{options, recipe.fractal};
    }
    case SurfaceNoiseKind::kensler_solid:
      return NoiseRecipe{common_options<GradientNoiseOptions>(recipe, kernel), recipe.fractal};
    case SurfaceNoiseKind::spectrum: {
      if (has_direction(recipe)) return std::nullopt;
      auto options = common_options<SpectrumNoiseOptions>(recipe, kernel);
      options.model = recipe.exemplar;
      options.channel = recipe.channel;
      if (may_filter(recipe)) options.filter = kernel.filter;
      return NoiseRecipe{options, recipe.fractal};
    }
    case SurfaceNoiseKind::surface:
    case SurfaceNoiseKind::oriented:
    case SurfaceNoiseKind::kensler:
      break;
  }
  return std::nullopt;
}

// Calls `use` with the noise of the tangent plane that one octave is, and the fields of its kernel.
template <typename Use>
auto with_tangent_noise(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel, const Use& use) {
  if (recipe.kind == SurfaceNoiseKind::kensler) {
    return use(ProjectedGradientNoise(common_options<ProjectedGradientOptions>(recipe, kernel)),
               KernelFields{});
  }
  if (recipe.kind == SurfaceNoiseKind::spectrum) {
    auto options = common_options<SpectrumNoiseOptions>(recipe, kernel);
    options.model = recipe.exemplar;
    options.channel = recipe.channel;
    options.filter = kernel.filter;
    return use(SurfaceSpectrumNoise(with_truncation_share(options), recipe.layer), kernel.fields);
  }
  auto options = common_options<SurfaceGaborOptions>(recipe, kernel);
  options.bandwidth = kernel.bandwidth;
  options.layer = recipe.layer;
  options.unit = kernel.fields.unit;
  options.filter = kernel.filter;
  if (recipe.kind == SurfaceNoiseKind::oriented) options.waves = GaborWaves::oriented;
  return use(SurfaceGaborNoise(with_truncation_share(options)), kernel.fields);
}

FieldPtr make_tangent_field(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  return with_tangent_noise(recipe, kernel, [](auto noise, const KernelFields& fields) {
    return tangent_field(std::move(noise), fields);
  });
}

// Whether noises of several frequencies make up for one whose kernels cannot vary.
bool is_graded(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  return kernel.fields.frequency && !has_bandwidth(recipe.kind);
}

// The streams of the grades, beside those of octaves and channels (SeedStream).
constexpr std::uint64_t kGradeStream = 3000;

FieldPtr make_graded(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  return make_graded_field(kernel.fields.frequency, kernel.fields.unit, [&](double frequency, int grade) {
    SurfaceNoiseRecipe single = recipe;
    single.seed = derive_seed(recipe.seed, kGradeStream + static_cast<std::uint64_t>(grade));
    SurfaceKernel own = kernel;
    own.frequency = frequency;
    own.fields.frequency = {};
    return make_surface_field(single, own);
  });
}

// Octave k by itself, but for its frequency, which is the kernel's.
SurfaceNoiseRecipe octave_of(const SurfaceNoiseRecipe& recipe, int k) {
  SurfaceNoiseRecipe octave = recipe;
  octave.fractal.octaves = 1;
  octave.kurtosis = recipe.fractal.kurtosis_of_octave(k, recipe.kurtosis);
  if (k > 0) octave.seed = derive_seed(recipe.seed, kOctaveStream + static_cast<std::uint64_t>(k));
  octave.evolve = evolution_of_octave(recipe.evolution(), recipe.fractal.frequency_ratio(k)).rate;
  return octave;
}

// Directions that are turned in the planes of points' normals.
class TurnedField final : public PointwiseField {
 public:
  TurnedField(FieldPtr directions, double radians)
      : directions_(std::move(directions)), cosine_(std::cos(radians)), sine_(std::sin(radians)) {}

  int channels() const override { return 3; }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    directions_->evaluate(points, samples);
    const std::size_t count = points.size();
    const std::span<float> values = samples.values;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec<3> normal = glm::normalize(points.normals[i]);
      const Vec<3> given(values[i], values[count + i], values[2 * count + i]);
      const Vec<3> flat = given - glm::dot(given, normal) * normal;
      const Vec<3> turned = cosine_ * flat + sine_ * glm::cross(normal, flat);
      for (std::size_t axis = 0; axis < 3; ++axis)
        values[axis * count + i] = static_cast<float>(turned[static_cast<int>(axis)]);
    }
  }

 private:
  FieldPtr directions_;
  double cosine_;
  double sine_;
};

}  // namespace

SurfaceKernel scaled(const SurfaceKernel& kernel, double ratio) {
  if (ratio == 1.0) return kernel;
  SurfaceKernel result = kernel;
  result.frequency *= ratio;
  if (VaryingParameter& frequency = result.fields.frequency) {
    frequency = {affine(frequency.field, ratio, 0.0), ratio * frequency.least, ratio * frequency.greatest};
  }
  return result;
}

SurfaceKernel turned(const SurfaceKernel& kernel, double degrees) {
  if (degrees == 0.0 || !kernel.fields.direction) return kernel;
  SurfaceKernel result = kernel;
  result.fields.direction =
      std::make_shared<TurnedField>(kernel.fields.direction, degrees * std::numbers::pi / 180.0);
  return result;
}

Components components_of(std::span<const Vec<3>> vectors) {
  Components components;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    components[axis].reserve(vectors.size());
    for (const Vec<3>& vector : vectors) {
      components[axis].push_back(static_cast<float>(vector[static_cast<int>(axis)]));
    }
  }
  return components;
}

void VertexField::evaluate(const Points<3>& points, const Samples<3>& samples) const {
  if (points.vertices.size() != points.size()) {
    throw std::invalid_argument("numbers of vertices are known at vertices only");
  }
  auto value = samples.values.begin();
  for (const std::span<const float> numbers : channels_) {
    for (const std::uint32_t vertex : points.vertices) *value++ = numbers[vertex];
  }
  for (const auto& derivative : samples.gradient) std::fill(derivative.begin(), derivative.end(), 0.0f);
}

bool may_filter(const SurfaceNoiseRecipe& recipe) {
  const bool is_filtered = has_bandwidth(recipe.kind) || recipe.kind == SurfaceNoiseKind::spectrum;
  return is_filtered && recipe.dims == 3;
}

bool may_filter(const SurfaceNoiseRecipe& recipe, const NoiseRecipe& noise) {
  return recipe.dims == 3 && can_filter(noise);
}

std::shared_ptr<const Noise<3>> solid_noise_of(const SurfaceNoiseRecipe& recipe, const NoiseRecipe& noise,
                                               double filter) {
  if (recipe.dims == 4) return slice(make_noise<4>(noise), recipe.time);
  const NoiseRecipe now = at_time(noise, recipe.time);
  return make_noise<3>(filter > 0.0 && may_filter(recipe, noise) ? filtered(now, filter) : now);
}

FieldPtr make_surface_field(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  recipe.validate();
  if (is_graded(recipe, kernel)) return make_graded(recipe, kernel);
  if (const auto solid = solid_recipe(recipe, kernel)) {
    if (kernel.fields.frequency || kernel.fields.bandwidth) {
      return make_varying_field(
          *solid, {recipe.dims, recipe.time, Vec<3>(0.0)},
          {kernel.fields.frequency, kernel.fields.bandwidth, nullptr, kernel.fields.unit});
    }
    return solid_noise_of(recipe, *solid);
  }
  const LayerNoise noise = surface_layer_noise(recipe, kernel);
  const std::vector<double> amplitudes = recipe.fractal.amplitudes();
  std::vector<FieldPtr> octaves;
  for (std::size_t k = 0; k < amplitudes.size(); ++k) {
    const FieldPtr octave = noise.octave(static_cast<int>(k));
    octaves.push_back(amplitudes[k] == 1.0 ? octave : affine(octave, amplitudes[k], 0.0));
  }
  return combine(Layer::Combine::sum, std::move(octaves));
}

LayerNoise surface_layer_noise(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  const auto octave = [=](int k) {
    const SurfaceNoiseRecipe single = octave_of(recipe, k);
    const SurfaceKernel own = scaled(kernel, recipe.fractal.frequency_ratio(k));
    const bool is_tangent = !solid_recipe(single, own) && !is_graded(single, own);
    return is_tangent ? make_tangent_field(single, own) : make_surface_field(single, own);
  };
  const auto channel = [=](int axis) {
    SurfaceNoiseRecipe other = recipe;
    other.seed = derive_seed(recipe.seed, kChannelStream + static_cast<std::uint64_t>(axis));
    return make_surface_field(other, kernel);
  };
  return {recipe.fractal, kernel.frequency, [=] { return make_surface_field(recipe, kernel); },
          octave,         channel,          kernel.fields.frequency.field};
}

double impulses_at_point(const SurfaceNoiseRecipe& recipe, const SurfaceKernel& kernel) {
  if (const auto solid = solid_recipe(recipe, kernel)) {
    const auto noise = solid_noise_of(recipe, *solid);
    const auto parts = noise->parts();
    double impulses = parts.empty() ? noise->waves().impulses : 0.0;
    for (const auto& part : parts) impulses += part.noise->waves().impulses;
    return impulses;
  }
  const auto of_octave = [](const auto& noise, const KernelFields& fields) {
    if constexpr (requires { noise.varying_impulses_per_kernel(); }) {
      if (fields.frequency || fields.bandwidth) return noise.varying_impulses_per_kernel();
    }
    if constexpr (requires { noise.impulses_per_kernel(); }) return noise.impulses_per_kernel();
    return 0.0;
  };
  double impulses = 0.0;
  for (int k = 0; k < recipe.fractal.octaves; ++k) {
    const SurfaceKernel own = scaled(kernel, recipe.fractal.frequency_ratio(k));
    impulses += with_tangent_noise(octave_of(recipe, k), own, of_octave);
  }
  return impulses;
}

}  // namespace solidnoise
