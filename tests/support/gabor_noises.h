#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "reference/gabor_reference.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/gabor/oriented_gabor_noise.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_strata.h"
#include "solidnoise/noise/point/scale_layout.h"

namespace solidnoise {

// The width of a noise's kernel: its support is a ball of this radius, or a cube of this half-width.
template <int Dim>
double support_of(const GaborNoise<Dim>& noise) {
  return noise.radius();
}
template <int Dim>
double support_of(const OrientedGaborNoise<Dim>& noise) {
  return noise.envelope().radius();
}

template <int Dim>
StrataChoice strata_of(const VaryingGaborOptions& options) {
  const double a = gaussian_parameter(options.frequency, options.bandwidth);
  return options.waves == GaborWaves::oriented
             ? strata_choice(EvenGaborKernel<Dim>(a, options.frequency))
             : strata_choice(IsotropicGaborKernel<Dim>::with_unit_peak(options.frequency, a), {});
}

// Where the impulses are if the frequency varies, and the scale in radii of the kernel.
template <int Dim>
ScaleLayout scales_of(const VaryingGaborNoise<Dim>& noise) {
  const auto& options = noise.options();
  const StrataChoice choice = strata_of<Dim>(options);
  return scale_layout(choice, impulse_density(Dim, options.impulses, choice.radius),
                      options.impulses_process);
}
template <int Dim>
double scale_in_radii(const VaryingGaborNoise<Dim>& noise) {
  return scales_of(noise).scale / noise.radius(noise.options().frequency, noise.options().bandwidth);
}

// The compact kernel, of one axis where it is a product.
template <int Dim>
const CompactKernel& profile(const GaborNoise<Dim>& noise) {
  return noise.compact_kernel();
}
template <int Dim>
const CompactKernel& profile(const OrientedGaborNoise<Dim>& noise) {
  return noise.envelope();
}

// Runs a check with the isotropic Gabor noise and with oriented ones of directions all around, in a cone and
// along one axis. Frequency 1, 20 impulses per kernel.
template <int Dim, typename Check>
void for_each_gabor_noise(const Check& check, double bandwidth = 1.0, double error = 0.02,
                          const Vec<4>& period = Vec<4>(0.0)) {
  SCOPED_TRACE(testing::Message() << "bandwidth " << bandwidth << ", error " << error);
  GaborNoiseOptions isotropic;
  isotropic.frequency = 1.0;
  isotropic.bandwidth = bandwidth;
  isotropic.error = error;
  isotropic.impulses = 20.0;
  isotropic.seed = 3;
  isotropic.period = period;
  {
    SCOPED_TRACE("isotropic");
    check(GaborNoise<Dim>(isotropic));
  }
  for (const double anisotropy : {0.0, 0.5, 1.0}) {
    SCOPED_TRACE(testing::Message() << "oriented, anisotropy " << anisotropy);
    OrientedGaborNoiseOptions oriented;
    oriented.frequency = 1.0;
    oriented.bandwidth = bandwidth;
    oriented.error = error;
    oriented.impulses = 20.0;
    oriented.anisotropy = anisotropy;
    oriented.direction = Vec<4>(0.6, -0.3, 1.0, 0.7);
    oriented.seed = 4;
    oriented.period = period;
    check(OrientedGaborNoise<Dim>(oriented));
  }
}

// A small lattice of odd counts that crosses 0, of several bricks, about 5 samples per support's radius.
template <int Dim>
Lattice<Dim> some_lattice(double support) {
  constexpr std::array kCount = {41, 15, 10, 5};
  Lattice<Dim> lattice;
  for (int axis = 0; axis < Dim; ++axis) {
    lattice.origin[axis] = 0.013 * axis;
    lattice.step[axis] = support / (4.6 + 0.7 * axis);
    lattice.first[axis] = -3 - axis;
    lattice.count[axis] = kCount[Dim - 1] + axis;
  }
  return lattice;
}

// At least the impulses of the cells up to `reach` cells away from a sample's, at their offsets from the
// sample, in world units. The sample's position is rounded to 2^-20 of a cell, as the library documents.
template <int Dim, typename Draw>
std::vector<reference::Impulse<Dim>> impulses_near(const ImpulseProcess<Dim>& process,
                                                   const Vec<Dim>& position, int reach, const Draw& draw) {
  constexpr double kQuanta = static_cast<double>(CellAxis::kQuantaPerCell);
  Index<Dim> home;
  Vec<Dim> fraction;
  for (int axis = 0; axis < Dim; ++axis) {
    const double cells = std::floor(position[axis] / process.axes()[axis].size() * kQuanta + 0.5) / kQuanta;
    home[axis] = static_cast<std::int64_t>(std::floor(cells));
    fraction[axis] = cells - std::floor(cells);
  }

  // Strata are shifted by up to a cell.
  std::vector<reference::Impulse<Dim>> impulses;
  const int across = 2 * reach + process.span();
  int strata = 1;
  for (int axis = 0; axis < Dim; ++axis) strata *= across;
  for (int i = 0; i < strata; ++i) {
    Index<Dim> step;
    int rest = i;
    for (int axis = 0; axis < Dim; ++axis) {
      step[axis] = rest % across - reach - process.span() + 1;
      rest /= across;
    }
    process.generate(home + step, [&](const Impulse<Dim>& found) {
      reference::Impulse<Dim> impulse = draw(found.mark);
      for (int axis = 0; axis < Dim; ++axis) {
        const double in_cells = static_cast<double>(step[axis]) + found.position[axis] / kQuanta;
        impulse.position[axis] = (in_cells - fraction[axis]) * process.axes()[axis].size();
      }
      impulses.push_back(impulse);
    });
  }
  return impulses;
}

// `radii` in cells, at least.
template <typename Noise>
int reach_in_cells(const Noise& noise, double radii) {
  double cells = 0.0;
  for (const CellAxis& axis : noise.impulses().axes()) {
    cells = std::max(cells, radii * support_of(noise) / axis.size());
  }
  return static_cast<int>(std::ceil(cells));
}

// Of a noise, up to some widths of its kernel away.
template <int Dim>
auto impulses_near(const GaborNoise<Dim>& noise, const Vec<Dim>& position, double radii = 1.0) {
  return impulses_near<Dim>(noise.impulses(), position, reach_in_cells(noise, radii),
                            [&](std::uint64_t mark) {
                              reference::Impulse<Dim> impulse;
                              impulse.weight = noise.weight(mark);
                              return impulse;
                            });
}

template <int Dim>
auto impulses_near(const OrientedGaborNoise<Dim>& noise, const Vec<Dim>& position, double radii = 1.0) {
  return impulses_near<Dim>(noise.impulses(), position, reach_in_cells(noise, radii),
                            [&](std::uint64_t mark) {
                              const auto wave = noise.wave(mark);
                              reference::Impulse<Dim> impulse;
                              for (int axis = 0; axis < Dim; ++axis)
                                impulse.frequency[axis] = wave.frequency[axis];
                              impulse.phase = wave.phase;
                              return impulse;
                            });
}

template <int Dim>
double length(const reference::Position<Dim>& offset) {
  double squared = 0.0;
  for (const double component : offset) squared += component * component;
  return std::sqrt(squared);
}

// The angle of an oriented kernel's wave at an offset from its impulse.
template <int Dim>
double wave_angle(const reference::Position<Dim>& offset, const reference::Impulse<Dim>& impulse) {
  double cycles = impulse.phase;
  for (int axis = 0; axis < Dim; ++axis) cycles += impulse.frequency[axis] * offset[axis];
  return 2.0 * std::numbers::pi * cycles;
}

// A noise's kernel in double precision, at an offset from an impulse: what the noise evaluates, its
// derivative along an axis, and the kernel of unlimited support that it stands for.
template <int Dim>
struct IsotropicReference {
  const GaborNoise<Dim>& noise;

  double value(const reference::Position<Dim>& offset, const reference::Impulse<Dim>& impulse) const {
    return impulse.weight * noise.compact_kernel().value(length<Dim>(offset));
  }
  double derivative(int axis, const reference::Position<Dim>& offset,
                    const reference::Impulse<Dim>& impulse) const {
    const double r = length<Dim>(offset);
    return r == 0.0 ? 0.0 : impulse.weight * noise.compact_kernel().derivative(r) * offset[axis] / r;
  }
  double unlimited(const reference::Position<Dim>& offset, const reference::Impulse<Dim>& impulse) const {
    return impulse.weight * noise.kernel().value(length<Dim>(offset));
  }
};

template <int Dim>
struct OrientedReference {
  const OrientedGaborNoise<Dim>& noise;

  // The product of the axes' envelopes, or its derivative along an axis; -1 for none.
  double envelope(const reference::Position<Dim>& offset, int derived) const {
    double product = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      const double d = std::abs(offset[axis]);
      const double slope = std::copysign(1.0, offset[axis]) * noise.envelope().derivative(d);
      product *= axis == derived ? slope : noise.envelope().value(d);
    }
    return product;
  }
  double value(const reference::Position<Dim>& offset, const reference::Impulse<Dim>& impulse) const {
    return envelope(offset, -1) * std::cos(wave_angle<Dim>(offset, impulse));
  }
  double derivative(int axis, const reference::Position<Dim>& offset,
                    const reference::Impulse<Dim>& impulse) const {
    const double angle = wave_angle<Dim>(offset, impulse);
    return envelope(offset, axis) * std::cos(angle) -
           2.0 * std::numbers::pi * impulse.frequency[axis] * envelope(offset, -1) * std::sin(angle);
  }
  double unlimited(const reference::Position<Dim>& offset, const reference::Impulse<Dim>& impulse) const {
    const double gaussian =
        std::exp(-std::numbers::pi * std::pow(noise.kernel().a() * length<Dim>(offset), 2));
    return gaussian * std::cos(wave_angle<Dim>(offset, impulse));
  }
};

template <int Dim>
IsotropicReference<Dim> kernel_reference(const GaborNoise<Dim>& noise) {
  return {noise};
}
template <int Dim>
OrientedReference<Dim> kernel_reference(const OrientedGaborNoise<Dim>& noise) {
  return {noise};
}

// A noise's value and derivatives at a position, plainly: its own impulses, kernels in double precision.
template <int Dim>
struct ReferenceSample {
  double value = 0.0;
  std::array<double, Dim> derivative{};
};

template <int Dim, template <int> class Noise>
ReferenceSample<Dim> reference_sample(const Noise<Dim>& noise, const Vec<Dim>& position) {
  using Offset = reference::Position<Dim>;
  using Impulse = reference::Impulse<Dim>;
  const auto kernel = kernel_reference(noise);
  std::vector<Impulse> reaching;
  for (const Impulse& impulse : impulses_near(noise, position)) {
    bool inside = true;
    for (const double component : impulse.position)
      inside = inside && std::abs(component) < support_of(noise);
    if (inside) reaching.push_back(impulse);
  }
  ReferenceSample<Dim> sample;
  sample.value =
      noise.amplitude() *
      reference::sum_impulses<Dim>(reaching, Offset{}, [&](const Offset& offset, const Impulse& impulse) {
        return kernel.value(offset, impulse);
      });
  for (int axis = 0; axis < Dim; ++axis) {
    sample.derivative[axis] =
        noise.amplitude() *
        reference::sum_impulses<Dim>(reaching, Offset{}, [&](const Offset& offset, const Impulse& impulse) {
          return kernel.derivative(axis, offset, impulse);
        });
  }
  return sample;
}

}  // namespace solidnoise
