#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/core/vec.h"

namespace solidnoise {

// What a block is multiplied by before its transform, along each axis. `hann`, sin^2(pi j / n), keeps the
// leakage of a band out of the rest of the spectrum (it falls off as f^-6); `none` is for periodic fields.
enum class Window { none, hann };

// The window's n values.
std::vector<double> window_values(Window window, int n);

struct PeriodogramOptions {
  Window window = Window::hann;
  double mean = 0.0;  // subtracted from every value; the noises have mean 0 by construction
};

// A two-sided power spectral density on the frequencies of a discrete Fourier transform, in value^2 per
// (cycle per unit)^Dim: summed over all frequencies, times the product of the frequency steps, it gives the
// variance.
template <int Dim>
struct PowerSpectrum {
  glm::vec<Dim, int> count{1};      // frequencies (and samples of a block) along each axis
  Vec<Dim> step{1.0};               // world units between the samples
  Window window = Window::hann;     // of the periodograms that were, or would be, averaged
  double independent_blocks = 1.0;  // how many independent periodograms scatter as much as this average
  double effective_volume = 0.0;  // of the data: a count of impulses in it scatters as much, world units^Dim
  std::vector<double> density;    // last axis fastest; index k > count / 2 is the frequency of k - count

  // The signed index of the frequency that is stored at `stored`.
  static int signed_index(int stored, int n) { return stored > n / 2 ? stored - n : stored; }

  double frequency_step(int axis) const { return 1.0 / (step[axis] * count[axis]); }
  double cell() const;      // product of the frequency steps
  double variance() const;  // sum of the density over all frequencies times cell()

  // Frequency vector of element `index`, cycles per world unit.
  Vec<Dim> frequency(std::size_t index) const;
};

// The average of windowed periodograms of blocks of one size (Welch's method). A block's periodogram is
// |sum_j w_j x_j exp(-2 pi i f.x_j)|^2 * (product of the steps) / sum_j w_j^2.
template <int Dim>
class PeriodogramAverage {
 public:
  // Throws std::invalid_argument for counts below 2 or steps that are not positive.
  PeriodogramAverage(const glm::vec<Dim, int>& count, const Vec<Dim>& step,
                     const PeriodogramOptions& options = {});

  // Adds the periodogram of one block, its last axis fastest; `block` has as many values as the counts say.
  void add(std::span<const float> block);

  // The average so far; the blocks are taken as independent. Precondition: at least one block.
  PowerSpectrum<Dim> spectrum() const;

 private:
  PeriodogramOptions options_;
  PowerSpectrum<Dim> sum_;
  std::vector<double> axis_windows_[Dim];
  double window_energy_ = 1.0;  // sum of the squared window over the block
  int blocks_ = 0;
};

// The periodogram of the whole field as one block.
template <int Dim>
PowerSpectrum<Dim> periodogram(const DenseField<Dim>& field, const PeriodogramOptions& options = {});

}  // namespace solidnoise
