#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/special_functions.h"
#include "support/independent_values.h"

namespace solidnoise {

// Fourier coefficients of a tile of side^Dim real samples, last axis fastest: the mean over the tile of the
// value times exp(-2 pi i k.x / side), in the same order. Axis by axis, by the definition.
template <int Dim>
std::vector<std::complex<float>> fourier_coefficients(const std::vector<float>& tile, int side) {
  const std::size_t n = static_cast<std::size_t>(side);
  std::vector<std::complex<float>> phases(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = -2.0 * std::numbers::pi * static_cast<double>(i) / side;
    phases[i] = std::complex<float>(std::polar(1.0 / side, angle));
  }
  std::vector<std::complex<float>> values(tile.begin(), tile.end());
  std::vector<std::complex<float>> row(n);
  for (int axis = 0; axis < Dim; ++axis) {
    std::size_t stride = 1;
    for (int a = Dim - 1; a > axis; --a) stride *= n;
    for (std::size_t start = 0; start < values.size(); ++start) {
      if (start / stride % n != 0) continue;
      for (std::size_t i = 0; i < n; ++i) row[i] = values[start + i * stride];
      for (std::size_t k = 0; k < n; ++k) {
        float real = 0.0f;
        float imaginary = 0.0f;
        for (std::size_t i = 0; i < n; ++i) {
          const std::complex<float> phase = phases[k * i % n];
          real += row[i].real() * phase.real() - row[i].imag() * phase.imag();
          imaginary += row[i].real() * phase.imag() + row[i].imag() * phase.real();
        }
        values[start + k * stride] = {real, imaginary};
      }
    }
  }
  return values;
}

// One wave of a tile: whole cycles per period along each axis.
template <int Dim>
using WaveNumber = glm::vec<Dim, int>;

// Compares the mean power of waves of periodic tiles with a closed form, bin by bin of waves. Tiles repeat
// exactly, so that no window is needed: the mean squared coefficient of wave k is S(k / P) / P^n to the last
// digit, but for aliases. Of each wave and its opposite one is taken.
template <int Dim>
class TileSpectrum {
 public:
  // `side` samples per period P.
  TileSpectrum(int side, double period) : side_(side), period_(period) {}

  // `bin_of(k)` is a wave's bin, or -1; `spectrum(f)` the closed form.
  template <typename BinOf, typename Spectrum>
  void set_bins(int count, const BinOf& bin_of, const Spectrum& spectrum) {
    bins_.assign(static_cast<std::size_t>(count), {});
    std::size_t waves = 1;
    for (int axis = 0; axis < Dim; ++axis) waves *= static_cast<std::size_t>(side_);
    for (std::size_t i = 0; i < waves; ++i) {
      const WaveNumber<Dim> k = wave(i);
      if (!is_of_upper_half(k)) continue;
      const int bin = bin_of(k);
      if (bin < 0 || bin >= count) continue;
      Vec<Dim> frequency;
      for (int axis = 0; axis < Dim; ++axis) frequency[axis] = k[axis] / period_;
      const double expected = spectrum(frequency) / std::pow(period_, Dim);
      Bin& chosen = bins_[static_cast<std::size_t>(bin)];
      chosen.waves.push_back(i);
      chosen.expected += expected;
      chosen.expected_squares += expected * expected;
    }
  }

  // Adds one realisation of the noise, of the period of this.
  void add(const Noise<Dim>& noise) {
    Lattice<Dim> lattice;
    lattice.step = Vec<Dim>(period_ / side_);
    lattice.count = glm::vec<Dim, int>(side_);
    const auto coefficients = fourier_coefficients<Dim>(values_of(noise, lattice), side_);
    for (Bin& bin : bins_) {
      for (const std::size_t i : bin.waves) bin.measured += std::norm(coefficients[i]);
    }
    ++tiles_;
  }

  // Chi-square test of each bin: two-sided, 1e-5 of false alarms each. A coefficient is nearly a complex
  // Gaussian, its square's standard deviation is its mean. A tile holds so few impulses that their number, or
  // how much of their power falls into a bin, also matters: `spread` is the mean square of an impulse's power
  // in a bin by the square of its mean, and `impulses` how many a tile has. `slack`: what the closed form may
  // differ by.
  void expect_closed_form(double impulses, double spread = 1.0, double slack = 0.0) const {
    for (std::size_t b = 0; b < bins_.size(); ++b) {
      const Bin& bin = bins_[b];
      ASSERT_FALSE(bin.waves.empty()) << "bin " << b;
      const double variance =
          (bin.expected_squares / (bin.expected * bin.expected) + spread / impulses) / tiles_;
      ASSERT_LT(variance, 0.02) << "bin " << b;  // else the test says little
      const double mean = bin.measured / tiles_ / bin.expected;
      const double degrees = 2.0 / variance;
      const double allowed_excess = mean / (1.0 + slack);
      const double allowed_lack = mean / (1.0 - slack);
      EXPECT_GT(regularized_gamma_q(0.5 * degrees, 0.5 * degrees * allowed_excess), kFalseAlarm)
          << "bin " << b << ": " << mean << " of the closed form, standard deviation " << std::sqrt(variance);
      EXPECT_LT(regularized_gamma_q(0.5 * degrees, 0.5 * degrees * allowed_lack), 1.0 - kFalseAlarm)
          << "bin " << b << ": " << mean << " of the closed form, standard deviation " << std::sqrt(variance);
    }
  }

 private:
  struct Bin {
    std::vector<std::size_t> waves;
    double expected = 0.0;
    double expected_squares = 0.0;
    double measured = 0.0;
  };

  WaveNumber<Dim> wave(std::size_t i) const {
    WaveNumber<Dim> k;
    for (int axis = Dim - 1; axis >= 0; --axis) {
      const int cycles = static_cast<int>(i % static_cast<std::size_t>(side_));
      k[axis] = cycles < side_ / 2 ? cycles : cycles - side_;
      i /= static_cast<std::size_t>(side_);
    }
    return k;
  }

  // Neither 0, nor at the highest frequency, nor the opposite of a wave that is.
  bool is_of_upper_half(const WaveNumber<Dim>& k) const {
    int first_sign = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      if (k[axis] == -side_ / 2) return false;
      if (first_sign == 0) first_sign = k[axis];
    }
    return first_sign > 0;
  }

  int side_;
  double period_;
  int tiles_ = 0;
  std::vector<Bin> bins_;
};

// A spectrum that depends on |k| alone, for waves of whole k per period, each value computed once.
template <typename Spectrum>
class RadialMemo {
 public:
  explicit RadialMemo(Spectrum spectrum) : spectrum_(spectrum) {}

  template <int Dim>
  double operator()(const glm::vec<Dim, double, glm::defaultp>& frequency) {
    double squared = 0.0;
    for (int axis = 0; axis < Dim; ++axis) squared += frequency[axis] * frequency[axis];
    const auto key = static_cast<std::int64_t>(std::llround(squared * 1e6));
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_[key] = spectrum_(std::sqrt(squared));
  }

 private:
  Spectrum spectrum_;
  std::map<std::int64_t, double> known_;
};

}  // namespace solidnoise
