#include "solidnoise/mesh/surface_octave.h"

#include <type_traits>

#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/spectrum_noise.h"
#include "solidnoise/noise/gabor/surface_gabor_noise.h"
#include "solidnoise/noise/gabor/surface_spectrum_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/gradient/projected_gradient_noise.h"

namespace solidnoise {
namespace {

class GaborOctave final : public SurfaceOctave {
 public:
  explicit GaborOctave(const SurfaceGaborOptions& options) : noise_(options) {}

  void evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                std::span<float> values) const override {
    noise_.evaluate(points, parameters, values);
  }
  Noise<2>::Band band() const override { return noise_.band(); }

 private:
  SurfaceGaborNoise noise_;
};

// The field of volumes, with kernels as exact as theirs, or its varying sibling where frequency or bandwidth
// vary.
class SolidOctave final : public SurfaceOctave {
 public:
  SolidOctave(const GaborNoiseOptions& options, const VaryingGaborOptions& varying)
      : noise_(options), varying_(varying) {}

  void evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                std::span<float> values) const override {
    if (parameters.radius_varies()) return varying_.evaluate(points.positions, parameters, values);
    noise_.evaluate(points.positions, {.values = values});
  }
  Noise<2>::Band band() const override { return {noise_.band().lower, noise_.band().upper}; }

 private:
  GaborNoise<3> noise_;
  VaryingGaborNoise<3> varying_;
};

class SpectrumOctave final : public SurfaceOctave {
 public:
  SpectrumOctave(const SpectrumNoiseOptions& options, double layer) : noise_(options, layer) {}

  void evaluate(const SurfacePoints& points, const VaryingParameters<3>& parameters,
                std::span<float> values) const override {
    noise_.evaluate(points, parameters.direction, values);
  }
  Noise<2>::Band band() const override { return noise_.band(); }

 private:
  SurfaceSpectrumNoise noise_;
};

// A noise that has no parameters but its options: of space, or projected.
template <class Fixed>
class FixedOctave final : public SurfaceOctave {
 public:
  template <class Options>
  explicit FixedOctave(const Options& options) : noise_(options) {}

  void evaluate(const SurfacePoints& points, const VaryingParameters<3>&,
                std::span<float> values) const override {
    if constexpr (std::is_same_v<Fixed, ProjectedGradientNoise>) {
      noise_.evaluate(points, values);
    } else {
      noise_.evaluate(points.positions, Samples<3>{.values = values});
    }
  }
  Noise<2>::Band band() const override { return {noise_.band().lower, noise_.band().upper}; }

 private:
  Fixed noise_;
};

}  // namespace

std::unique_ptr<SurfaceOctave> make_surface_octave(const SurfaceNoiseRecipe& recipe, double frequency,
                                                   double bandwidth, std::uint64_t seed) {
  switch (recipe.kind) {
    case SurfaceNoiseKind::surface:
    case SurfaceNoiseKind::oriented: {
      SurfaceGaborOptions options;
      options.frequency = frequency;
      options.bandwidth = bandwidth;
      options.error = recipe.error;
      options.impulses = recipe.impulses;
      options.layer = recipe.layer;
      options.seed = seed;
      if (recipe.kind == SurfaceNoiseKind::oriented) options.waves = GaborWaves::oriented;
      return std::make_unique<GaborOctave>(options);
    }
    case SurfaceNoiseKind::solid: {
      GaborNoiseOptions options;
      options.frequency = frequency;
      options.bandwidth = bandwidth;
      options.error = recipe.error;
      options.impulses = recipe.impulses;
      options.seed = seed;
      VaryingGaborOptions varying;
      varying.frequency = frequency;
      varying.bandwidth = bandwidth;
      varying.error = recipe.error;
      varying.impulses = recipe.impulses;
      varying.seed = seed;
      return std::make_unique<SolidOctave>(with_truncation_share(options), varying);
    }
    case SurfaceNoiseKind::kensler:
      return std::make_unique<FixedOctave<ProjectedGradientNoise>>(
          ProjectedGradientOptions{.frequency = frequency, .seed = seed});
    case SurfaceNoiseKind::spectrum: {
      SpectrumNoiseOptions options;
      options.model = recipe.exemplar;
      options.channel = recipe.channel;
      options.frequency = frequency;
      options.error = recipe.error;
      options.impulses = recipe.impulses;
      options.seed = seed;
      if (has_direction(recipe)) return std::make_unique<SpectrumOctave>(options, recipe.layer);
      return std::make_unique<FixedOctave<SpectrumNoise<3>>>(with_truncation_share(options));
    }
    case SurfaceNoiseKind::kensler_solid:
      break;
  }
  return std::make_unique<FixedOctave<GradientNoise<3>>>(
      GradientNoiseOptions{.frequency = frequency, .seed = seed});
}

}  // namespace solidnoise
