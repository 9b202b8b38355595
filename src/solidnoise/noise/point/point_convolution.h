#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "solidnoise/core/field.h"
#include "solidnoise/core/points.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/kernel/kernel_family.h"

namespace solidnoise {

// A point with the kernel that the noise has there.
template <int Dim>
struct KernelPoint {
  double radius = 1.0;     // of the kernel, world units
  double scale = 1.0;      // that the impulses of a hierarchy of grids follow, world units: a length of the
                           // kernel that does not depend on its error
  double amplitude = 1.0;  // that makes the standard deviation of the value what it should be
  double flatness = 1.0;   // half the thickness of its layer, in radii, over Settings::layer; at most 1
  KernelFamily::Member kernel;
  std::array<double, Dim> wave{};  // of an oriented kernel, cycles per world unit
  std::array<double, 3> normal{};  // of a layer, unit length
};

// The same point with its kernel filtered (KernelFamily::filtered): wider along the surface alone, at the
// same impulses.
template <int Dim>
void filter_kernel(KernelPoint<Dim>& point, const KernelFamily::Filtered& filtered, double frequency) {
  point.kernel = filtered.kernel;
  point.radius *= filtered.widening;
  point.flatness = 1.0 / filtered.widening;
  point.amplitude *= filtered.peak;
  for (double& wave : point.wave) wave *= filtered.frequency / frequency;
}

// Sparse convolution in which the kernel belongs to the evaluation point (Lagae et al. 2011, section V): the
// sum, over the impulses near a point, of that point's kernel. Points are put in spatial order and gathered
// into clusters that share their impulses.
template <int Dim>
class PointConvolution {
 public:
  struct Settings {
    GaborWaves waves = GaborWaves::isotropic;
    // Half the thickness of the layer around a surface that impulses are taken from, in kernel radii; 0: no
    // layer, the kernel is a ball. In 3D only.
    double layer = 0.0;
    // Of one grid, for kernels of one radius: cells' side, world units. Else 0: a hierarchy of grids, in
    // which impulses have the turns of ScaleFade.
    double side = 0.0;
    ImpulseCount count{};  // of a cell
    // Of a hierarchy: the sides of its grids are this, world units, times a power of two. What is as much
    // larger in all of space has the same values.
    double unit = 1.0;
    std::uint64_t seed = 0;
    // Of mean square 1: what the weight of an impulse is multiplied by; empty: 1.
    std::function<double(std::uint64_t mark)> factor{};
  };
  explicit PointConvolution(const Settings& settings);

  // Mean square of the sum at amplitude 1, per unit of the integral of the kernel's square over space, in
  // units of world units^Dim of one grid, of the scale^Dim of a hierarchy.
  double power() const { return power_; }

  // Says what the kernels at some points are: those with the numbers `points`, one kernel for each.
  using Prepare =
      std::function<void(std::span<const std::size_t> points, std::span<KernelPoint<Dim>> kernels)>;
  // Calls `prepare` once for each point. The gradient is the derivative by the point's position while its
  // kernel stays as it is, of a layer the part that is along the surface. Serial.
  void evaluate(const Points<Dim>& points, const Prepare& prepare, const Samples<Dim>& samples) const;

 private:
  class Evaluation;

  ImpulseProcess<Dim> grid(int level, double cell_size) const;

  Settings settings_;
  double power_ = 0.0;
  std::optional<ImpulseProcess<Dim>> process_;  // of all grids, but for their cells and keys
};

// The window of a layer, as a function of the offset along the normal in half thicknesses, and the integrals
// of its powers: h(u) = (1 - u^2)^2. Cheap, and value and slope are continuous at |u| = 1. (Kensler et al.
// 2008 have a cubic Hermite window; any even window will do, as the variance is proportional to the integral
// of h^2.)
double layer_window(double u);
double layer_window_moment(int power);  // integral of h^power from -1 to 1

}  // namespace solidnoise
