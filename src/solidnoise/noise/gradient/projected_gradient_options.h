#pragma once

#include <cstdint>

#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/point/point_cluster.h"

namespace solidnoise {

// Parameters of Kensler's gradient noise projected on surfaces (Kensler, Knoll, Shirley 2008, section 4).
struct ProjectedGradientOptions {
  using Kernel = GradientNoiseOptions::Kernel;
  using Support = GradientNoiseOptions::Support;
  using Hash = GradientNoiseOptions::Hash;
  using Window = ProjectedKernel::Window;

  double frequency = 8.0;  // frequency at which the radial power on a plane peaks, cycles per world unit; > 0
  Kernel kernel = Kernel::kensler;
  Support support = Support::full;  // half: 8 times fewer lattice points, and a window twice as wide
  // hermite: as published. cosine: the variance of a plane along the axes is the same between the layers of
  // the lattice as in them.
  Window window = Window::hermite;
  Hash hash = Hash::xor_tables;
  std::uint64_t seed = 0;

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const ProjectedGradientOptions&, const ProjectedGradientOptions&) = default;
};

}  // namespace solidnoise
