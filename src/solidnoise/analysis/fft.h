#pragma once

#include <complex>
#include <span>
#include <vector>

namespace solidnoise {

enum class FftDirection { forward, inverse };

// The discrete Fourier transform of an array of 1 to 4 (or more) axes with the last one fastest, in place and
// in double precision: X_k = sum_j x_j exp(-2 pi i j.k / n), with + for the inverse. Neither direction
// divides by the size. Any counts; products of 2, 3 and 5 are fast. Throws std::invalid_argument if
// data.size() is not the product of the counts.
void fft(std::span<std::complex<double>> data, std::span<const int> counts, FftDirection direction);

// The forward transform of real values: all coefficients, at half of the cost.
std::vector<std::complex<double>> fft_of_real(std::span<const double> values, std::span<const int> counts);

}  // namespace solidnoise
