#include "solidnoise/noise/gabor/surface_spectrum_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/spectrum_bands.h"
#include "solidnoise/noise/gabor/wave_filter.h"
#include "solidnoise/noise/kernel/compact_gradient.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/point/point_convolution.h"
#include "solidnoise/noise/point/surface_sum.h"

namespace solidnoise {
namespace {

constexpr int kNoPowers = 0;  // the degree up to which envelopes are in powers

// The window's integrals, times half the layer's thickness.
KernelMoments layer_moments(const CompactKernel& envelope, double half_thickness) {
  return {0.5 * envelope.energy() * half_thickness * layer_window_moment(2),
          0.375 * envelope.fourth_moment() * half_thickness * layer_window_moment(4)};
}

// The energy of envelope^2 cos^2 over that of envelope^2 / 2, of a band of Gaussian parameter a, by |w|^2.
struct WaveEnergy {
  double sharpness;

  explicit WaveEnergy(double a) : sharpness(2.0 * std::numbers::pi / (a * a)) {}
  double operator()(double square) const { return 1.0 + std::exp(-sharpness * square); }
};

}  // namespace

// The kernels of one band, and the grid of their impulses.
class SurfaceSpectrumNoise::Band {
 public:
  // Of the band before it is filtered, with the envelope after; `half_thickness` of the layer, world units.
  Band(const SpectrumBand& band, bool isotropic, const WaveFilter& filter, const CompactKernel& envelope,
       double half_thickness, double amplitude, const ImpulseLayout<3>& layout, const Evolution& evolution,
       std::uint64_t seed)
      : frequencies_(band, isotropic),
        filter_(filter),
        energy_(band.a),
        axis_(layout.axes[0]),
        radius_(static_cast<float>(envelope.radius() / axis_.size())),
        layer_(half_thickness / envelope.radius()),
        amplitude_(amplitude),
        process_(layout.axes, layout.count, derive_seed(seed, kImpulseStream)),
        kernel_{to_single_precision(envelope, kNoPowers)} {
    if (evolution.moves()) turning_.emplace(evolution);
  }

  const CellAxis& axis() const { return axis_; }
  float radius() const { return radius_; }  // in cells
  double layer() const { return layer_; }
  int span() const { return process_.span(); }

  // Appends the impulses of a row of strata relative to the anchor.
  void append(const Index<3>& anchor, const Index<3>& first, const Index<3>& last,
              const ImpulseReach<3>& reach, ImpulseList& impulses) const {
    process_.generate(anchor + first, anchor + last, reach, [&](const FoundImpulse& impulse) {
      const std::size_t end = impulses.size();
      impulses.reserve(end + 1);
      for (int axis = 0; axis < 3; ++axis) {
        impulses.position(axis)[end] =
            static_cast<float>(impulse.position(axis)) / static_cast<float>(CellAxis::kQuantaPerCell);
      }
      RandomStream stream(impulse.mark);
      double weight = stream.next() >> 63 ? 1.0 : -1.0;
      if (turning_) weight *= (*turning_)(impulse.mark);
      const Vec<2> wave = frequencies_(share_of(impulse.mark), stream);
      const double square = glm::dot(wave, wave);
      weight *= filter_.weight(square) * amplitude_ / std::sqrt(energy_(square));
      impulses.attribute(kWaveX)[end] = static_cast<float>(filter_.narrower * wave.x * axis_.size());
      impulses.attribute(kWaveY)[end] = static_cast<float>(filter_.narrower * wave.y * axis_.size());
      impulses.attribute(kWaveWeight)[end] = static_cast<float>(weight);
      impulses.set_size(end + 1);
    });
  }

  void sum(const PointCluster& cluster, const ImpulseList& impulses, ClusterSums& sums) const {
    sum_layer_waves(kernel_, cluster, impulses, sums);
  }

 private:
  ComponentDraw<2> frequencies_;
  WaveFilter filter_;
  std::optional<TurningFactor> turning_;
  WaveEnergy energy_;
  CellAxis axis_;
  float radius_;
  double layer_;
  double amplitude_;
  ImpulseProcess<3> process_;
  LayerWaveKernel kernel_;
};

SurfaceSpectrumNoise::SurfaceSpectrumNoise(const SpectrumNoiseOptions& options, double layer) {
  options.validate();
  require_in_range("layer", layer, 0.1, 1.0, "kernel radii");
  if (options.period != Vec<4>(0.0)) throw std::invalid_argument("a noise on a surface has no period");
  spectrum_ = of_unit_variance(options.spectrum());
  if (spectrum_.dimensions != 2) {
    throw std::invalid_argument(
        fmt::format("the spectrum is of {} dimensions; it must be of 2", spectrum_.dimensions));
  }
  const WeightMoments turns = options.evolution.moves() ? turning({}) : WeightMoments{};
  for (const SpectrumBand& band : spectrum_.bands) {
    const RandomPhaseGaborKernel<2> kernel(1.0, band.a, Vec<2>(0.0));
    const double radius = kernel.radius_for_error(kNominalError);
    shares_.push_back({variance_of(band), 2.0 * std::numbers::pi * layer * std::pow(radius, 3),
                       layer_strata_choice(kernel, layer * radius, layer_window)});
  }
  const ImpulseBudget budget = share_impulses(shares_, options.impulses, options.impulses_process);
  if (options.impulses_process == ImpulseSpread::strata) densities_ = budget.densities;
  impulses_ = budget.impulses;
  const auto gaussian_of = [&](const SpectrumBand& band, double error) {
    return options.bounds_gradient ? compact_gaussian_with_gradient(band.a, rms_frequency(band), 2, error)
                                   : compact_gaussian(band.a, 2, error);
  };
  // Impulses, what they draw and the amplitude are those of the noise before it is filtered.
  const GaborSpectrum unfiltered = spectrum_;
  spectrum_.bands.clear();
  for (std::size_t b = 0; b < shares_.size(); ++b) {
    const auto& [variance, support, choice] = shares_[b];
    const SpectrumBand& band = unfiltered.bands[b];
    const double half_thickness = layer * choice.radius;
    CompactKernel envelope = gaussian_of(band, options.error);
    KernelMoments moments = layer_moments(envelope, half_thickness);
    const auto layout =
        make_layout<3>(choice, budget.densities[b], options.impulses_process, envelope.radius(), Vec<4>(0.0));
    double amplitude = std::sqrt(variance / noise_variance(layout.density, moments.second));
    WaveFilter filter;
    WeightMoments weights = turns;
    spectrum_.bands.push_back(band);
    if (options.filter > 0.0) {
      const double width = filter_bandwidth(options.filter);
      GaborSpectrum one = unfiltered;
      one.bands = {band};
      const SpectrumBand left = one.filtered(width).bands.front();
      const FilteredShare share{std::sqrt(variance_of(left) / variance), band.a / left.a};
      spectrum_.bands.pop_back();
      if (share.nothing(options.error)) continue;
      filter = WaveFilter(band, width);
      const WaveEnergy before(band.a);
      const WaveEnergy after(left.a);
      const WeightMoments passed = filter.moments(band, [&](double square) {
        return after(filter.narrower * filter.narrower * square) / before(square);
      });
      weights = {weights.second * passed.second, weights.fourth * passed.fourth};
      envelope = gaussian_of(left, share.error(options.error));
      moments = layer_moments(envelope, half_thickness);
      amplitude *= filter.amplitude(2);
      spectrum_.bands.push_back(left);
    }
    if (layout.count.is_fixed) moments.overlap = choice.averages->overlap(layout.cubes());
    const double left = amplitude * amplitude * noise_variance(layout.density, moments.second, weights);
    const double scale = left / variance_of(spectrum_.bands.back());
    for (SpectrumComponent& component : spectrum_.bands.back().components) component.variance *= scale;
    variance_ += left;
    excess_kurtosis_ += left * left * noise_excess_kurtosis(layout.density, moments, weights);
    bands_.emplace_back(band, unfiltered.isotropic, filter, envelope, half_thickness, amplitude, layout,
                        options.evolution, derive_seed(options.seed, kBandStream + b));
  }
  if (bands_.empty()) spectrum_ = unfiltered;
  if (variance_ > 0.0) excess_kurtosis_ /= variance_ * variance_;
}

SurfaceSpectrumNoise::~SurfaceSpectrumNoise() = default;
SurfaceSpectrumNoise::SurfaceSpectrumNoise(SurfaceSpectrumNoise&&) noexcept = default;

void SurfaceSpectrumNoise::evaluate(const SurfacePoints& points,
                                    const std::array<std::span<const float>, 3>& tangent,
                                    const Samples<3>& samples) const {
  points.validate();
  for (const auto& component : tangent) {
    if (component.size() == points.positions.size()) continue;
    throw std::invalid_argument(fmt::format("tangent is given for {} points; there are {}", component.size(),
                                            points.positions.size()));
  }
  sum_on_surface<Band>(bands_, points, tangent, samples);
}

Noise<2>::Band SurfaceSpectrumNoise::band() const {
  return frequency_interval(spectrum_);
}

}  // namespace solidnoise
