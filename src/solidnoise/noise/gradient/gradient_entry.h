#pragma once

#include <cmath>
#include <string_view>
#include <type_traits>
#include <vector>

#include "solidnoise/noise/gradient/gradient_noise.h"
#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/noise_entry.h"

namespace solidnoise {

inline constexpr Choices<GradientNoiseOptions::Kernel, 2> kGradientKernelChoices{{
    {GradientNoiseOptions::Kernel::kensler, "kensler"},
    {GradientNoiseOptions::Kernel::zero_dc, "zero-dc"},
}};

inline constexpr Choices<GradientNoiseOptions::Support, 2> kGradientSupportChoices{{
    {GradientNoiseOptions::Support::full, "full"},
    {GradientNoiseOptions::Support::half, "half"},
}};

inline constexpr Choices<GradientNoiseOptions::Hash, 2> kGradientHashChoices{{
    {GradientNoiseOptions::Hash::xor_tables, "xor-tables"},
    {GradientNoiseOptions::Hash::integer, "integer"},
}};

constexpr auto fields_of(std::type_identity<GradientNoiseOptions>) {
  using Options = GradientNoiseOptions;
  return list_fields(fields_of_frequency<Options>(),
                     field("kernel", &Options::kernel, kGradientKernelChoices,
                           "As published, or without power at frequency 0"),
                     field("support", &Options::support, kGradientSupportChoices,
                           "All lattice points, or those of even coordinates"),
                     field("hash", &Options::hash, kGradientHashChoices,
                           "As published, repeating every 256 lattice steps, or never"),
                     fields_of_place<Options>());
}

template <>
struct NoiseEntry<GradientNoiseOptions> {
  static constexpr std::string_view kName = "kensler";
  static constexpr std::string_view kTitle = "kensler noise";
  static constexpr std::string_view kHelp = "Gradient noise: quick, of a broad band";
  static constexpr int kLeastDimensions = 1;
  static constexpr int kMostDimensions = 4;
  template <int Dim>
  using Noise = GradientNoise<Dim>;

  template <int Dim>
  static void describe(const GradientNoiseOptions& options, const auto& of_kernel, const auto& of_noise) {
    const GradientNoise<Dim> noise(options);
    const Vec<Dim>& spacing = noise.lattice_spacing();
    of_kernel("kind", "radial gradient");
    of_kernel("frequency", noise.options().frequency);
    of_kernel("radius", GradientKernel<Dim>::kRadius * spacing[0]);
    of_noise("lattice_spacing", std::vector<double>(&spacing[0], &spacing[0] + Dim));
  }

  // With a gradient along x.
  template <int Dim>
  static KernelSlice slice(const GradientNoiseOptions& options) {
    const GradientNoise<Dim> noise(options);
    const double spacing = noise.lattice_spacing()[0];
    return {GradientKernel<Dim>::kRadius * spacing, [kernel = noise.kernel(), spacing](double x, double y) {
              return kernel.value(std::hypot(x, y) / spacing) * x / spacing;
            }};
  }
};

}  // namespace solidnoise
