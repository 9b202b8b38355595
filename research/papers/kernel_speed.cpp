#include "papers/kernel_speed.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "papers/paper_kernel.h"
#include "papers/stopwatch.h"
#include "reference/gabor_reference.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise::papers {
namespace {

constexpr double kError = 0.02;
constexpr double kImpulses = 32.0;

template <int Dim>
RandomPhaseGaborKernel<Dim> oriented_kernel() {
  Vec<Dim> frequency(0.0);
  frequency[0] = kFrequency;
  return {1.0, kGaussian, frequency};
}

template <int Dim>
Lattice<Dim> lattice() {
  Lattice<Dim> result;
  for (int axis = 0; axis < std::min(Dim, 3); ++axis) result.count[axis] = Dim == 2 ? 256 : 64;
  return result;
}

template <int Dim>
double nanoseconds(const Noise<Dim>& noise) {
  const Lattice<Dim> samples = lattice<Dim>();
  std::vector<float> values(samples.size());
  return 1e9 * quickest(5, [&] { noise.evaluate(samples, {.values = values}); }) /
         static_cast<double>(values.size());
}

template <int Dim, template <int, typename> class Kernel>
double procedure_nanoseconds(double radius, double impulses) {
  const reference::GaborProcedure<Dim, Kernel, float> noise({kFrequency, kGaussian}, radius, impulses, 1);
  constexpr int kPoints = Dim == 4 ? 1000 : 5000;
  volatile float sink = 0.0f;
  const double seconds = quickest(3, [&] {
    float sum = 0.0f;
    for (int i = 0; i < kPoints; ++i) {
      reference::Position<Dim, float> point;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        point[axis] = static_cast<float>(i) * (1.31f + 0.17f * static_cast<float>(axis));
      }
      sum += noise(point);
    }
    sink = sum;
  });
  return 1e9 * seconds / kPoints;
}

}  // namespace

template <int Dim>
KernelSpeed measure_kernel_speed(Comparison comparison) {
  const auto isotropic = IsotropicGaborKernel<Dim>::with_unit_peak(kFrequency, kGaussian);
  const RandomPhaseGaborKernel<Dim> oriented = oriented_kernel<Dim>();
  const double isotropic_radius = isotropic.radius_for_error(kError);
  const double oriented_radius = oriented.radius_for_error(kError);
  GaborNoiseOptions isotropic_options;
  isotropic_options.frequency = kFrequency;
  isotropic_options.impulses_process = ImpulseSpread::poisson;
  OrientedGaborNoiseOptions oriented_options;
  oriented_options.frequency = kFrequency;
  oriented_options.impulses_process = ImpulseSpread::poisson;

  KernelSpeed speed;
  speed.isotropic_impulses = kImpulses;
  speed.anisotropic_impulses = kImpulses;
  if (comparison == Comparison::same_density) {
    const double density = impulse_density(Dim, kImpulses, isotropic_radius);
    speed.anisotropic_impulses = impulses_in_ball(Dim, density, oriented_radius);
    isotropic_options.impulses = impulses_in_ball(Dim, density, isotropic.radius_for_error(kNominalError));
    oriented_options.impulses = impulses_in_ball(Dim, density, oriented.radius_for_error(kNominalError));
  } else if (comparison == Comparison::same_number) {
    isotropic_options.impulses = kImpulses;
    oriented_options.impulses = kImpulses;
  } else {
    speed.isotropic_impulses =
        impulses_for_quality(Dim, isotropic_radius, {isotropic.energy(), isotropic.fourth_moment()},
                             weight_moments(ImpulseWeights::uniform));
    speed.anisotropic_impulses =
        impulses_for_quality(Dim, oriented_radius, {oriented.energy(), oriented.fourth_moment()});
  }
  speed.isotropic_procedure =
      procedure_nanoseconds<Dim, reference::IsotropicKernel>(isotropic_radius, speed.isotropic_impulses);
  speed.anisotropic_procedure =
      procedure_nanoseconds<Dim, reference::OrientedKernel>(oriented_radius, speed.anisotropic_impulses);
  speed.isotropic_block = nanoseconds(GaborNoise<Dim>(isotropic_options));
  speed.anisotropic_block = nanoseconds(OrientedGaborNoise<Dim>(oriented_options));
  return speed;
}

template KernelSpeed measure_kernel_speed<2>(Comparison);
template KernelSpeed measure_kernel_speed<3>(Comparison);
template KernelSpeed measure_kernel_speed<4>(Comparison);

}  // namespace solidnoise::papers
