#pragma once

#include "solidnoise/core/vec.h"

namespace solidnoise {

// An axis-aligned box in world units; both corners belong to it.
template <int Dim>
struct Box {
  Vec<Dim> lower{0.0};
  Vec<Dim> upper{0.0};
};

}  // namespace solidnoise
