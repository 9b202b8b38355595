#pragma once

#include <cstdint>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// Parameters of Kensler's gradient noise (Kensler, Knoll, Shirley 2008).
struct GradientNoiseOptions {
  enum class Kernel {
    kensler,  // s = 4 t^5 - 3 t^4, as published
    zero_dc,  // coefficients for which the spectrum has no power at 0, whatever the dimension
  };
  enum class Support {
    full,  // every lattice point
    half,  // lattice points with even coordinates only: 2^Dim times fewer, and as many times less variance
           // before scaling
  };
  enum class Hash {
    xor_tables,  // exclusive-or of one 256-entry permutation per axis, as published; repeats every 256
                 // lattice steps
    integer,     // hash of the 64-bit lattice coordinates; does not repeat
  };

  double frequency = 8.0;  // frequency at which the radial power peaks, cycles per world unit; > 0
  Kernel kernel = Kernel::kensler;
  Support support = Support::full;
  Hash hash = Hash::xor_tables;
  std::uint64_t seed = 0;
  Vec<4> period{0.0};  // world units per axis (x, y, z, t); 0: none

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  friend bool operator==(const GradientNoiseOptions&, const GradientNoiseOptions&) = default;
};

}  // namespace solidnoise
