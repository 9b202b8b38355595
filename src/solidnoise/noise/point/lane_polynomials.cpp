#include "solidnoise/noise/point/lane_polynomials.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace solidnoise {
namespace {

constexpr std::size_t kAlignment = 64;

bool same(const KernelFamily::Member& a, const KernelFamily::Member& b) {
  return a.lower == b.lower && a.upper == b.upper && a.blend == b.blend;
}

bool all_same(LanePolynomials::Kernels kernels, const KernelFamily::Member& kernel) {
  return std::all_of(kernels.begin(), kernels.end(),
                     [&](const KernelFamily::Member* other) { return same(*other, kernel); });
}

// Those that Horner's rule is compiled for.
int padded_degree(int degree) {
  if (degree <= 4) return 4;
  return degree <= 8 ? 8 : KernelFamily::kMostHornerDegree;
}

float* aligned(float* memory) {
  const auto past = reinterpret_cast<std::uintptr_t>(memory) % kAlignment;
  return memory + (kAlignment - past) % kAlignment / sizeof(float);
}

}  // namespace

const PointPolynomials& LanePolynomials::fill(Kernels kernels, bool power) {
  // Most often all kernels are the same, and those of the last cluster too.
  if (power == polynomials_.power && all_same(kernels, filled_)) return polynomials_;

  int degree = 0;
  for (const KernelFamily::Member* kernel : kernels) degree = std::max(degree, kernel->degree());
  polynomials_.power = power;
  polynomials_.degree = power ? padded_degree(degree) : degree;
  const std::size_t needed = static_cast<std::size_t>(polynomials_.degree + 1) * PointCluster::kSamples;
  memory_.resize(std::max(memory_.size(), needed + kAlignment / sizeof(float)));
  coefficients_ = aligned(memory_.data());
  polynomials_.coefficients = coefficients_;
  for (std::size_t lane = 0; lane < PointCluster::kSamples; ++lane) {
    fill_lane(*kernels[std::min(lane, kernels.size() - 1)], lane);
  }
  filled_ = all_same(kernels, *kernels.front()) ? *kernels.front() : KernelFamily::Member{};
  return polynomials_;
}

void LanePolynomials::fill_lane(const KernelFamily::Member& kernel, std::size_t lane) {
  const auto& lower = polynomials_.power ? kernel.lower->coefficients : kernel.lower->chebyshev;
  const auto& upper = polynomials_.power ? kernel.upper->coefficients : kernel.upper->chebyshev;
  const float blend = static_cast<float>(kernel.blend);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(polynomials_.degree); ++k) {
    const float a = k < lower.size() ? lower[k] : 0.0f;
    const float b = k < upper.size() ? upper[k] : 0.0f;
    coefficients_[k * PointCluster::kSamples + lane] = (1.0f - blend) * a + blend * b;
  }
}

}  // namespace solidnoise
