#pragma once

#include <type_traits>

#include "solidnoise/noise/gradient/gradient_noise_options.h"
#include "solidnoise/noise/noise_fields.h"

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

}  // namespace solidnoise
