#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/noise.h"

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

// A velocity without divergence: the curl of a vector potential of three noises,
//   v = s curl psi = s (d psi_z/dy - d psi_y/dz, d psi_x/dz - d psi_z/dx, d psi_y/dx - d psi_x/dy),
// with the noises' analytic derivatives (Bridson et al. 2007). The scale s is such that the root
// mean square of |v| over all seeds is a given speed, by the closed form
//   E|v|^2 = s^2 sum over c of sum over b != c of E[(d psi_c/d x_b)^2]   (Noise::gradient_variance).
// Each component is a sum of two noises of mean 0; of isotropic noises, v is isotropic.
struct CurlOptions {
  std::array<std::shared_ptr<const Noise<3>>, 3> potentials;  // independent of each other
  double speed = 1.0;  // root mean square, world units per second, away from boundaries
  Vec<3> drift{0.0};   // a mean velocity, which is added; world units per second

  // E|curl psi|^2 that the speed is of, where it is not that of the potentials: of the unfiltered ones, so
  // that a filter takes from the speed what it does not let pass.
  std::optional<double> mean_square;

  // Near a surface the potential is ramped down to its part along the normal, so that nothing flows through
  // (Bridson et al. 2007): with d the distance, g its gradient, D its reach,
  //   psi' = a psi + (1 - |a|) (g.psi) g,   a = ramp(d / D),   ramp(r) = 15/8 r - 5/4 r^3 + 3/8 r^5,
  // and -1 and 1 beyond. Its curl is taken by the product rule,
  //   v = s (a curl psi + a' g x psi + (1 - |a|) grad(g.psi) x g),
  // which takes second derivatives of the distance. The paper gives the outside alone; here the ramp is odd,
  // so that v goes on continuously inside, and farther inside than D is -s curl psi. v is without divergence,
  // and on the surface d = 0 it is tangential to it.
  std::shared_ptr<const SmoothDistance> boundary;  // null: none
};

// Throws std::invalid_argument if the speed is not positive and finite, or a potential is missing.
FieldPtr make_curl_field(const CurlOptions& options);

// E|curl psi|^2 of three independent noises that are alike.
double curl_mean_square(const Noise<3>& potential);

}  // namespace solidnoise
