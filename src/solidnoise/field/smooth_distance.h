#pragma once

#include <array>
#include <span>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// The signed distance to a surface as a function with two continuous derivatives: positive outside, world
// units. Its gradient is the gradient of a function, everywhere, so that what is made from it has exactly the
// derivatives that are computed. Immutable; may be shared between threads.
class SmoothDistance {
 public:
  virtual ~SmoothDistance() = default;

  // Up to where distances are known, on either side; world units.
  virtual double reach() const = 0;

  struct Jet {
    double distance = 0.0;
    Vec<3> gradient{0.0};
    std::array<Vec<3>, 3> hessian{Vec<3>(0.0), Vec<3>(0.0), Vec<3>(0.0)};  // rows; symmetric
  };

  // The distance and its derivatives, one for each position; farther away than reach() the distance alone,
  // which then is somewhat inaccurate, but not less than reach() in absolute value.
  virtual void evaluate(std::span<const Vec<3>> positions, std::span<Jet> jets) const = 0;
};

}  // namespace solidnoise
