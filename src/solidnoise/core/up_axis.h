#pragma once

#include "solidnoise/core/choices.h"

namespace solidnoise {

// Which way is up.
enum class UpAxis { y, z };

inline constexpr Choices<UpAxis, 2> kUpAxisChoices{{{UpAxis::y, "y"}, {UpAxis::z, "z"}}};

}  // namespace solidnoise
