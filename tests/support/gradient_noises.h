#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "reference/kensler_reference.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "support/evaluated.h"

namespace solidnoise {

// Runs a check with each kernel, support and hash of gradient noise.
template <typename Check>
void for_each_gradient_noise(const Check& check) {
  using Options = GradientNoiseOptions;
  for (const auto kernel : {Options::Kernel::kensler, Options::Kernel::zero_dc}) {
    for (const auto support : {Options::Support::full, Options::Support::half}) {
      for (const auto hash : {Options::Hash::xor_tables, Options::Hash::integer}) {
        SCOPED_TRACE(testing::Message() << "kernel " << static_cast<int>(kernel) << ", support "
                                        << static_cast<int>(support) << ", hash " << static_cast<int>(hash));
        Options options;
        options.kernel = kernel;
        options.support = support;
        options.hash = hash;
        options.seed = 20;
        check(options);
      }
    }
  }
}

// The noise by the paper's procedure in double precision, scaled as the library does.
template <int Dim>
class ReferenceNoise {
 public:
  using Position = typename reference::KenslerProcedure<Dim>::Position;

  explicit ReferenceNoise(const GradientNoise<Dim>& noise)
      : procedure_(setting(noise)),
        spacing_(noise.lattice_spacing()),
        steps_(noise.options().support == GradientNoiseOptions::Support::half ? 2.0 : 1.0),
        amplitude_(1.0 / std::sqrt(noise.kernel().mean_variance())) {}

  double value(const Vec<Dim>& position) const { return amplitude_ * procedure_(in_lattice(position)); }

  // By central differences of the procedure: their error is about 1e-4^2 / 6 times the third derivative per
  // lattice unit, (2 pi 0.7)^2 times the first: 3e-8 of it.
  double derivative(const Vec<Dim>& position, int axis) const {
    constexpr double kStep = 1e-4;
    const std::size_t a = static_cast<std::size_t>(axis);
    Position above = in_lattice(position);
    Position below = above;
    above[a] += kStep;
    below[a] -= kStep;
    return amplitude_ * (procedure_(above) - procedure_(below)) / (2.0 * kStep * spacing_[axis]);
  }

 private:
  static typename reference::KenslerProcedure<Dim>::Setting setting(const GradientNoise<Dim>& noise) {
    const GradientNoiseOptions& options = noise.options();
    typename reference::KenslerProcedure<Dim>::Setting setting;
    const bool zero_dc = options.kernel == GradientNoiseOptions::Kernel::zero_dc;
    // 1D to 4D, from the paper and from c1 - c2 = 1, c2 / c1 = 5 / (n / 2 + 6).
    constexpr std::array kZeroDcC1 = {13.0 / 3.0, 3.5, 3.0, 8.0 / 3.0};
    setting.c1 = zero_dc ? kZeroDcC1[Dim - 1] : 4.0;
    setting.c2 = setting.c1 - 1.0;
    setting.stride = options.support == GradientNoiseOptions::Support::half ? 2 : 1;
    setting.integer_hash = options.hash == GradientNoiseOptions::Hash::integer;
    setting.seed = options.seed;
    for (int axis = 0; axis < Dim; ++axis) {
      setting.period[static_cast<std::size_t>(axis)] =
          static_cast<std::int64_t>(std::round(options.period[axis] / noise.lattice_spacing()[axis]));
    }
    return setting;
  }

  // Lattice coordinates, rounded to 2^-20 of a cell as the library documents.
  Position in_lattice(const Vec<Dim>& position) const {
    const double quantum = steps_ * 0x1p-20;
    Position rounded;
    for (int axis = 0; axis < Dim; ++axis) {
      rounded[static_cast<std::size_t>(axis)] =
          std::floor(position[axis] / spacing_[axis] / quantum + 0.5) * quantum;
    }
    return rounded;
  }

  reference::KenslerProcedure<Dim> procedure_;
  Vec<Dim> spacing_;
  double steps_;
  double amplitude_;
};

}  // namespace solidnoise
