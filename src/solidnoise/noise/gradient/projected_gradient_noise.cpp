#include "solidnoise/noise/gradient/projected_gradient_noise.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/noise/point/point_order.h"
#include "solidnoise/noise/point/point_tile.h"

namespace solidnoise {
namespace {

constexpr std::size_t kBatch = 4096;  // points that are located together

ProjectedGradientOptions validated(const ProjectedGradientOptions& options) {
  options.validate();
  return options;
}

bool is_half(const ProjectedGradientOptions& options) {
  return options.support == ProjectedGradientOptions::Support::half;
}

// Integral over |o| < H of the window's square.
double window_power(const ProjectedGradientOptions& options) {
  const double of_unit = options.window == ProjectedGradientOptions::Window::hermite ? 26.0 / 35.0 : 1.0;
  return is_half(options) ? 2.0 * of_unit : of_unit;
}

// The cells whose corners are the lattice points.
std::array<CellAxis, 3> make_axes(const ProjectedGradientOptions& options, double spacing) {
  std::array<CellAxis, 3> axes;
  axes.fill(CellAxis(is_half(options) ? 2.0 * spacing : spacing));
  return axes;
}

// One call of ProjectedGradientNoise::evaluate().
class Evaluation {
 public:
  Evaluation(const ProjectedGradientNoise& noise, const GradientLattice<3>& lattice,
             const GradientKernel<2>& kernel)
      : lattice_(lattice),
        axis_(make_axes(noise.options(), noise.lattice_spacing())[0]),
        radius_(is_half(noise.options()) ? 1.0f : 2.0f),
        extent_(1.0 / radius_) {
    kernel_.window = noise.options().window;
    kernel_.root = static_cast<float>(kernel.c2() / kernel.c1());
    // Offsets are in cells, of 2 / radius_ lattice units.
    const double scale = kernel.c1() / std::sqrt(noise.lattice_variance()) * 2.0 / radius_;
    for (std::size_t i = 0; i < kGradients; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        gradients_[i][static_cast<std::size_t>(axis)] =
            static_cast<float>(scale * lattice.gradients()[i][axis]);
      }
    }
    cluster_.count = 0;
    for (std::size_t lane = 0; lane < PointCluster::kSamples; ++lane) {
      cluster_.inverse_square_radius[lane] = 1.0f / (radius_ * radius_);
      cluster_.inverse_square_height[lane] = 1.0f;
    }
  }

  void run(const SurfacePoints& points, std::span<float> values) {
    const std::vector<std::size_t> order = spatial_order(points.positions);
    for (std::size_t first = 0; first < order.size(); first += kBatch) {
      const auto batch = std::span(order).subspan(first, std::min(kBatch, order.size() - first));
      locate(points, batch);
      std::span<LocatedPoint<3>> rest = located_;
      while (!rest.empty()) evaluate_tile(PointTile<3>(rest), batch, values);
    }
  }

 private:
  void locate(const SurfacePoints& points, std::span<const std::size_t> batch) {
    located_.resize(batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i) {
      LocatedPoint<3>& point = located_[i];
      Vec<3> normal;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const CellPosition position =
            locate_point(axis_, points.positions.coordinate(batch[i], axis), batch[i]);
        point.cell[axis] = position.cell;
        point.fraction[a] = position.fraction;
        normal[axis] = points.normal[a][batch[i]];
      }
      normal = glm::normalize(normal);
      for (int axis = 0; axis < 3; ++axis) {
        point.normal[static_cast<std::size_t>(axis)] = static_cast<float>(normal[axis]);
      }
      point.radius = radius_;
      point.density = 1.0f;
      point.point = static_cast<std::uint32_t>(i);
    }
  }

  void evaluate_tile(const PointTile<3>& tile, std::span<const std::size_t> batch, std::span<float> values) {
    gathered_.clear();
    for_each_reaching_cell<3>(bounds<3>(tile.points, extent_),
                              [&](const Index<3>& cell) { append_lattice_point(tile.anchor, cell); });
    for (std::size_t first = 0; first < tile.points.size(); first += PointCluster::kSamples) {
      const auto points = tile.points.subspan(
          first, std::min<std::size_t>(PointCluster::kSamples, tile.points.size() - first));
      alignas(64) float sums[PointCluster::kSamples];
      sum(points, sums);
      for (std::size_t i = 0; i < points.size(); ++i) values[batch[points[i].point]] = sums[i];
    }
  }

  void append_lattice_point(const Index<3>& anchor, const Index<3>& cell) {
    const auto& gradient = gradients_[lattice_.gradient_index(anchor + cell)];
    const std::size_t end = gathered_.size();
    gathered_.reserve(end + 1);
    for (int axis = 0; axis < 3; ++axis) {
      gathered_.position(axis)[end] = static_cast<float>(cell[axis]);
      gathered_.attribute(PointImpulses::kGradientX + axis)[end] = gradient[static_cast<std::size_t>(axis)];
    }
    gathered_.set_size(end + 1);
  }

  void sum(std::span<const LocatedPoint<3>> points, float* sums) {
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
      }
    }
    sum_projected(kernel_, cluster_, kept_, sums);
  }

  const GradientLattice<3>& lattice_;
  CellAxis axis_;
  float radius_;  // in cells: 2, and the window 1; or, with half resolution, both 1
  KernelExtent extent_;
  ProjectedKernel kernel_;
  std::array<std::array<float, 3>, kGradients> gradients_;
  std::vector<LocatedPoint<3>> located_;
  PointImpulses gathered_;
  PointImpulses kept_;
  PointCluster cluster_;
};

}  // namespace

ProjectedGradientNoise::ProjectedGradientNoise(const ProjectedGradientOptions& options)
    : options_(validated(options)), kernel_(options.kernel) {
  spacing_ = kernel_.radial_peak() / options.frequency;
  const double density = is_half(options) ? 1.0 / 8.0 : 1.0;
  lattice_variance_ = density * window_power(options) * 2.0 / 3.0 * kernel_.mean_variance();
  const GradientNoiseOptions of_lattice{
      .support = options.support, .hash = options.hash, .seed = options.seed};
  lattice_ = std::make_shared<GradientLattice<3>>(of_lattice, make_axes(options, spacing_));
}

void ProjectedGradientNoise::evaluate(const SurfacePoints& points, std::span<float> values) const {
  points.validate();
  Evaluation(*this, *lattice_, kernel_).run(points, values);
}

double ProjectedGradientNoise::power_spectrum(const Vec<2>& f) const {
  return kernel_.power_spectrum(spacing_ * glm::length(f)) * spacing_ * spacing_ / kernel_.mean_variance();
}

Noise<2>::Band ProjectedGradientNoise::band() const {
  const Noise<2>::Band steps = kernel_.band();
  return {steps.lower / spacing_, steps.upper / spacing_};
}

}  // namespace solidnoise
