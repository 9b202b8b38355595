#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

namespace solidnoise {

// Counts of an array's three axes, the last one fastest. Two-dimensional arrays have one element along the
// middle axis.
using Counts3 = std::array<int, 3>;

// The half of an even array, x(-k) = x(k), that is stored: indices 0 to n/2 of its first or of its last axis.
enum class HalfAxis { first, last };

Counts3 half_counts(const Counts3& counts, HalfAxis half);
std::size_t element_count(const Counts3& counts);

// The discrete Fourier transform of real arrays that are even: X_k = sum_j x_j exp(-2 pi i j.k / n) is real
// and even again, and the transform is its own inverse but for the division by the size. It takes one half of
// the array and gives the other, at a quarter of a complex transform's cost: power spectra are stored with
// half of the last axis here, autocovariances with half of the first.
class EvenTransform {
 public:
  // Throws std::invalid_argument for counts below 1.
  explicit EvenTransform(const Counts3& counts);
  ~EvenTransform();
  EvenTransform(EvenTransform&&) noexcept;

  // From half of the last axis to half of the first, and back; neither divides by the size. Any thread.
  void to_lags(std::span<const double> frequencies, std::span<double> lags) const;
  void to_frequencies(std::span<const double> lags, std::span<double> frequencies) const;

 private:
  struct Plans;

  Counts3 counts_;
  std::unique_ptr<const Plans> plans_;
};

}  // namespace solidnoise
