#include "solidnoise/noise/gradient/projected_gradient_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/point/surface_sum.h"

namespace solidnoise {

void ProjectedGradientOptions::validate() const {
  require("frequency", frequency, kFrequencies, "cycles per world unit");
  evolution.validate();
}

namespace {

ProjectedGradientOptions validated(const ProjectedGradientOptions& options) {
  options.validate();
  return options;
}

constexpr double kWindowPower = 26.0 / 35.0;  // integral over |o| < 1 of the window's square

// What turns the gradients of lattice points.
class TurningGradients {
 public:
  // Precondition: options.evolution.moves(), valid.
  explicit TurningGradients(const ProjectedGradientOptions& options)
      : turns_(options.evolution), key_(derive_seed(options.seed, kTurningStream)) {}

  Vec<3> turned(const Vec<3>& gradient, const Index<3>& cell) const {
    using std::numbers::pi;
    const std::uint64_t mark = hash_cell<3>(cell, key_);
    const double angle = 2.0 * pi * turns_.at(mark);
    // Towards a direction across the gradient.
    const double place = 2.0 * pi * RandomStream(mark).next_unit();
    const Vec<3> away = std::abs(gradient.x) < 0.5 ? Vec<3>(1.0, 0.0, 0.0) : Vec<3>(0.0, 1.0, 0.0);
    const Vec<3> first = glm::normalize(glm::cross(gradient, away));
    const Vec<3> across = std::cos(place) * first + std::sin(place) * glm::cross(gradient, first);
    return std::cos(angle) * gradient + std::sin(angle) * across;
  }

 private:
  static constexpr std::uint64_t kTurningStream = 100;  // of the seed, besides those of the lattice

  ImpulseTurns turns_;
  std::uint64_t key_;
};

// The lattice points as a source of sum_on_surface().
class LatticePoints {
 public:
  LatticePoints(const ProjectedGradientNoise& noise, const GradientLattice<3>& lattice,
                const GradientKernel<2>& kernel)
      : lattice_(lattice),
        axis_(noise.lattice_spacing()),
        kernel_{static_cast<float>(kernel.c2() / kernel.c1())},
        scale_(kernel.c1() / std::sqrt(noise.lattice_variance())) {
    if (noise.options().evolution.moves()) turning_.emplace(noise.options());
  }

  const CellAxis& axis() const { return axis_; }
  float radius() const { return GradientKernel<2>::kRadius; }
  double layer() const { return 1.0 / GradientKernel<2>::kRadius; }
  int span() const { return 1; }

  void append(const Index<3>& anchor, const Index<3>& first, const Index<3>& last, const ImpulseReach<3>&,
              ImpulseList& points) const {
    for (Index<3> cell = first; cell[2] <= last[2]; ++cell[2]) {
      Vec<3> gradient = lattice_.gradients()[lattice_.gradient_index(anchor + cell)];
      if (turning_) gradient = turning_->turned(gradient, anchor + cell);
      const std::size_t end = points.size();
      points.reserve(end + 1);
      for (int axis = 0; axis < 3; ++axis) {
        points.position(axis)[end] = static_cast<float>(cell[axis]);
        points.attribute(kGradientX + axis)[end] = static_cast<float>(scale_ * gradient[axis]);
      }
      points.set_size(end + 1);
    }
  }

  void sum(const PointCluster& cluster, const ImpulseList& points, ClusterSums& sums) const {
    sum_projected(kernel_, cluster, points, sums);
  }

 private:
  const GradientLattice<3>& lattice_;
  CellAxis axis_;
  ProjectedKernel kernel_;
  double scale_;  // of gradients
  std::optional<TurningGradients> turning_;
};

}  // namespace

ProjectedGradientNoise::ProjectedGradientNoise(const ProjectedGradientOptions& options)
    : options_(validated(options)) {
  spacing_ = kernel_.radial_peak() / options.frequency;
  lattice_variance_ = kWindowPower * 2.0 / 3.0 * kernel_.mean_variance();
  std::array<CellAxis, 3> axes;  // of the cells whose corners are the lattice points
  axes.fill(CellAxis(spacing_));
  lattice_ = std::make_shared<GradientLattice<3>>(GradientNoiseOptions{.seed = options.seed}, axes);
}

void ProjectedGradientNoise::evaluate(const SurfacePoints& points, const Samples<3>& samples) const {
  points.validate();
  const LatticePoints source(*this, *lattice_, kernel_);
  sum_on_surface<LatticePoints>({&source, 1}, points, {}, samples);
}

Noise<2>::Band ProjectedGradientNoise::band() const {
  const Noise<2>::Band steps = kernel_.band();
  return {steps.lower / spacing_, steps.upper / spacing_};
}

}  // namespace solidnoise
