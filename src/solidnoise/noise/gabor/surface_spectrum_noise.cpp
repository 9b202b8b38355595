#include "solidnoise/noise/gabor/surface_spectrum_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/spectrum_bands.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/point/point_convolution.h"
#include "solidnoise/noise/point/surface_sum.h"

namespace solidnoise {
namespace {

// Moments of a kernel in the layer, of a wave of random sign whose cosine squared is 1/2 on average.
KernelMoments layer_moments(const CompactKernel& envelope, double half_thickness) {
  return {0.5 * envelope.energy() * half_thickness * layer_window_moment(2),
          0.375 * envelope.fourth_moment() * half_thickness * layer_window_moment(4)};
}

}  // namespace

// The kernels of one band, and the grid of their impulses.
class SurfaceSpectrumNoise::Band {
 public:
  Band(const SpectrumBand& band, bool isotropic, const CompactKernel& envelope, double layer,
       double amplitude, double density, std::uint64_t seed)
      : frequencies_(band, isotropic),
        sharpness_(2.0 * std::numbers::pi / (band.a * band.a)),
        axis_(envelope.radius() * std::hypot(1.0, layer)),
        radius_(static_cast<float>(envelope.radius() / axis_.size())),
        layer_(layer),
        amplitude_(amplitude),
        process_({axis_, axis_, axis_}, density * std::pow(axis_.size(), 3),
                 derive_seed(seed, kImpulseStream)) {
    for (const double c : envelope.chebyshev_coefficients())
      kernel_.envelope.push_back(static_cast<float>(c));
  }

  const CellAxis& axis() const { return axis_; }
  float radius() const { return radius_; }  // in cells
  double layer() const { return layer_; }

  // Appends the impulses of a cell relative to the anchor.
  void append(const Index<3>& anchor, const Index<3>& cell, ImpulseList& impulses) const {
    process_.generate(anchor + cell, [&](const Impulse<3>& impulse) {
      const std::size_t end = impulses.size();
      impulses.reserve(end + 1);
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        impulses.position(axis)[end] =
            static_cast<float>(cell[axis]) +
            static_cast<float>(impulse.position[a]) / static_cast<float>(CellAxis::kQuantaPerCell);
      }
      RandomStream stream(impulse.mark);
      const double sign = stream.next() >> 63 ? 1.0 : -1.0;
      const Vec<2> wave = frequencies_(stream);
      // The energy of envelope^2 cos^2 over that of envelope^2 / 2.
      const double energy = 1.0 + std::exp(-sharpness_ * glm::dot(wave, wave));
      impulses.attribute(kWaveX)[end] = static_cast<float>(wave.x * axis_.size());
      impulses.attribute(kWaveY)[end] = static_cast<float>(wave.y * axis_.size());
      impulses.attribute(kWaveWeight)[end] = static_cast<float>(sign * amplitude_ / std::sqrt(energy));
      impulses.set_size(end + 1);
    });
  }

  void sum(const PointCluster& cluster, const ImpulseList& impulses, ClusterSums& sums) const {
    sum_layer_waves(kernel_, cluster, impulses, sums);
  }

 private:
  ComponentDraw<2> frequencies_;
  double sharpness_;
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
  if (options.evolution.moves()) throw std::invalid_argument("a noise on a surface does not evolve");
  spectrum_ = of_unit_variance(options.spectrum());
  if (spectrum_.dimensions != 2) {
    throw std::invalid_argument(
        fmt::format("the spectrum is of {} dimensions; it must be of 2", spectrum_.dimensions));
  }
  std::vector<CompactKernel> envelopes;
  std::vector<BandShare> shares;
  for (const SpectrumBand& band : spectrum_.bands) {
    const CompactKernel& envelope = envelopes.emplace_back(compact_gaussian(band.a, 2, options.error));
    const double radius = envelope.radius();
    shares.push_back({variance_of(band), layer_moments(envelope, layer * radius),
                      2.0 * std::numbers::pi * layer * std::pow(radius, 3)});
  }
  const ImpulseBudget budget = share_impulses(shares, options.impulses);
  impulses_ = budget.impulses;
  excess_kurtosis_ = budget.excess_kurtosis;
  for (std::size_t b = 0; b < shares.size(); ++b) {
    const auto [density, amplitude] = budget.bands[b];
    bands_.emplace_back(spectrum_.bands[b], spectrum_.isotropic, envelopes[b], layer, amplitude, density,
                        derive_seed(options.seed, kBandStream + b));
  }
}

SurfaceSpectrumNoise::~SurfaceSpectrumNoise() = default;
SurfaceSpectrumNoise::SurfaceSpectrumNoise(SurfaceSpectrumNoise&&) noexcept = default;

void SurfaceSpectrumNoise::evaluate(const SurfacePoints& points,
                                    const std::array<std::span<const float>, 3>& tangent,
                                    std::span<float> values) const {
  points.validate();
  for (const auto& component : tangent) {
    if (component.size() == points.positions.size()) continue;
    throw std::invalid_argument(fmt::format("tangent is given for {} points; there are {}", component.size(),
                                            points.positions.size()));
  }
  sum_on_surface<Band>(bands_, points, tangent, values);
}

Noise<2>::Band SurfaceSpectrumNoise::band() const {
  return frequency_interval(spectrum_);
}

}  // namespace solidnoise
