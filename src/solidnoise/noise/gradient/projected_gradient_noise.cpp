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
        axis_(make_axes(noise.options(), noise.lattice_spacing())[0]),
        radius_(is_half(noise.options()) ? 1.0f : 2.0f) {
    kernel_.window = noise.options().window;
    kernel_.root = static_cast<float>(kernel.c2() / kernel.c1());
    // Offsets are in cells, of 2 / radius_ lattice units.
    scale_ = kernel.c1() / std::sqrt(noise.lattice_variance()) * 2.0 / radius_;
    if (noise.options().evolution.moves()) turning_.emplace(noise.options());
  }

  const CellAxis& axis() const { return axis_; }
  float radius() const { return radius_; }
  double layer() const { return 1.0 / radius_; }
  int span() const { return 1; }

  void append(const Index<3>& anchor, const Index<3>& cell, const ImpulseReach<3>&,
              ImpulseList& points) const {
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

  void sum(const PointCluster& cluster, const ImpulseList& points, ClusterSums& sums) const {
    sum_projected(kernel_, cluster, points, sums);
  }

 private:
  const GradientLattice<3>& lattice_;
  CellAxis axis_;
  float radius_;  // in cells: 2, and the window 1; or, with half resolution, both 1
  ProjectedKernel kernel_;
  double scale_ = 1.0;  // of gradients
  std::optional<TurningGradients> turning_;
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

void ProjectedGradientNoise::evaluate(const SurfacePoints& points, const Samples<3>& samples) const {
  points.validate();
  const LatticePoints source(*this, *lattice_, kernel_);
  sum_on_surface<LatticePoints>({&source, 1}, points, {}, samples);
}

double ProjectedGradientNoise::power_spectrum(const Vec<2>& f) const {
  return kernel_.power_spectrum(spacing_ * glm::length(f)) * spacing_ * spacing_ / kernel_.mean_variance();
}

Noise<2>::Band ProjectedGradientNoise::band() const {
  const Noise<2>::Band steps = kernel_.band();
  return {steps.lower / spacing_, steps.upper / spacing_};
}

}  // namespace solidnoise
