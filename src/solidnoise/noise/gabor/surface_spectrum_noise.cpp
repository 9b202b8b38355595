#include "solidnoise/noise/gabor/surface_spectrum_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/gabor/spectrum_bands.h"
#include "solidnoise/noise/kernel/compact_kernel.h"
#include "solidnoise/noise/point/point_convolution.h"
#include "solidnoise/noise/point/point_order.h"
#include "solidnoise/noise/point/point_tile.h"

namespace solidnoise {
namespace {

constexpr std::size_t kBatch = 4096;  // points that are located together

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
  const LayerWaveKernel& kernel() const { return kernel_; }

  // Appends the impulses of a cell relative to the anchor.
  void append(const Index<3>& anchor, const Index<3>& cell, PointImpulses& impulses) const {
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
      impulses.attribute(PointImpulses::kWaveX)[end] = static_cast<float>(wave.x * axis_.size());
      impulses.attribute(PointImpulses::kWaveY)[end] = static_cast<float>(wave.y * axis_.size());
      impulses.attribute(PointImpulses::kWaveWeight)[end] =
          static_cast<float>(sign * amplitude_ / std::sqrt(energy));
      impulses.set_size(end + 1);
    });
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

namespace {

// One call of evaluate(), for one band.
template <typename Band>
class Evaluation {
 public:
  explicit Evaluation(const Band& band) : band_(band), extent_(band.layer()) {
    const float height = band.radius() * extent_.layer;
    for (std::size_t lane = 0; lane < PointCluster::kSamples; ++lane) {
      cluster_.inverse_square_radius[lane] = 1.0f / (band.radius() * band.radius());
      cluster_.inverse_square_height[lane] = 1.0f / (height * height);
    }
  }

  // Adds to the values of a batch.
  void add(const SurfacePoints& points, std::span<const std::size_t> batch, std::span<const Vec<3>> normals,
           std::span<const Vec<3>> tangents, std::span<float> values) {
    locate(points, batch, normals);
    std::span<LocatedPoint<3>> rest = located_;
    while (!rest.empty()) add_tile(PointTile<3>(rest), batch, tangents, values);
  }

 private:
  void locate(const SurfacePoints& points, std::span<const std::size_t> batch,
              std::span<const Vec<3>> normals) {
    located_.resize(batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i) {
      LocatedPoint<3>& point = located_[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const CellPosition position =
            locate_point(band_.axis(), points.positions.coordinate(batch[i], axis), batch[i]);
        point.cell[axis] = position.cell;
        point.fraction[a] = position.fraction;
        point.normal[a] = static_cast<float>(normals[i][axis]);
      }
      point.radius = band_.radius();
      point.density = 1.0f;
      point.point = static_cast<std::uint32_t>(i);
    }
  }

  void add_tile(const PointTile<3>& tile, std::span<const std::size_t> batch,
                std::span<const Vec<3>> tangents, std::span<float> values) {
    gathered_.clear();
    for_each_reaching_cell<3>(bounds<3>(tile.points, extent_),
                              [&](const Index<3>& cell) { band_.append(tile.anchor, cell, gathered_); });
    for (std::size_t first = 0; first < tile.points.size(); first += PointCluster::kSamples) {
      const auto points = tile.points.subspan(
          first, std::min<std::size_t>(PointCluster::kSamples, tile.points.size() - first));
      alignas(64) float sums[PointCluster::kSamples];
      sum(points, tangents, sums);
      for (std::size_t i = 0; i < points.size(); ++i) values[batch[points[i].point]] += sums[i];
    }
  }

  void sum(std::span<const LocatedPoint<3>> points, std::span<const Vec<3>> tangents, float* sums) {
    PointCull cull = bounds<3>(points, extent_);
    cull.attributes = 3;
    kept_.clear();
    cull_impulses(gathered_, cull, kept_);
    cluster_.count = static_cast<int>(points.size());
    for (std::size_t lane = 0; lane < PointCluster::kSamples; ++lane) {
      const LocatedPoint<3>& point = points[std::min(lane, points.size() - 1)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        cluster_.coordinate[axis][lane] = point.at[axis];
        cluster_.normal[axis][lane] = point.normal[axis];
        cluster_.tangent[axis][lane] = static_cast<float>(tangents[point.point][static_cast<int>(axis)]);
      }
    }
    sum_layer_waves(band_.kernel(), cluster_, kept_, sums);
  }

  const Band& band_;
  KernelExtent extent_;
  std::vector<LocatedPoint<3>> located_;
  PointImpulses gathered_;
  PointImpulses kept_;
  PointCluster cluster_;
};

}  // namespace

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
    if (component.size() == points.positions.count) continue;
    throw std::invalid_argument(fmt::format("tangent is given for {} points; there are {}", component.size(),
                                            points.positions.count));
  }
  std::fill(values.begin(), values.end(), 0.0f);
  std::vector<Evaluation<Band>> evaluations(bands_.begin(), bands_.end());
  const std::vector<std::size_t> order = spatial_order(points.positions);
  std::vector<Vec<3>> normals;
  std::vector<Vec<3>> tangents;
  for (std::size_t first = 0; first < order.size(); first += kBatch) {
    const auto batch = std::span(order).subspan(first, std::min(kBatch, order.size() - first));
    normals.clear();
    tangents.clear();
    for (const std::size_t i : batch) {
      normals.push_back(
          glm::normalize(Vec<3>(points.normal[0][i], points.normal[1][i], points.normal[2][i])));
      tangents.push_back(unit_tangent({tangent[0][i], tangent[1][i], tangent[2][i]}, normals.back()));
    }
    for (auto& evaluation : evaluations) evaluation.add(points, batch, normals, tangents, values);
  }
}

Noise<2>::Band SurfaceSpectrumNoise::band() const {
  return frequency_interval(spectrum_);
}

}  // namespace solidnoise
