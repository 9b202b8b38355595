#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solidnoise/analysis/exemplar/even_transform.h"

namespace solidnoise {

// One width of Gaussians, and where they may be.
struct AtomBand {
  double a = 0.0;               // of exp(-2 pi |f|^2 / a^2), cycles per world unit
  Counts3 spacing = {1, 1, 1};  // between the Gaussians' centres, in frequencies; divides the counts
};

// The grid of frequencies of a discrete Fourier transform.
struct FrequencyGrid {
  int dimensions = 2;                      // 2 or 3
  Counts3 count = {1, 1, 1};               // 1 along the middle axis in 2D
  std::array<double, 3> step = {1, 1, 1};  // between frequencies, cycles per world unit

  // The dimension that an axis of the arrays is: 0, (none,) 1 in 2D.
  int dimension_of(int axis) const { return dimensions == 2 && axis == 2 ? 1 : axis; }
  std::size_t size() const { return element_count(count); }
};

// The dictionary that power spectra are decomposed into: pairs of Gaussians h(f - w) + h(f + w), h(f) =
// c exp(-2 pi |f|^2 / a^2), on the torus of the discrete frequencies, with c = 1 / sqrt(2 sum h^2) such that
// a pair has length 1 (one with w = -w has sqrt 2). The paper (Galerne et al. 2012, eq. 8) leaves them
// unnormalised, which lets an l1 penalty pick the narrowest band alone.
//
// A coefficient per band and frequency is stored with half of the last axis, on the coarser grid of the
// band's spacing; where both w and -w are stored they are equal, and are one coefficient. Spectra are held as
// their Fourier transforms, autocovariances, with half of the first axis: convolutions are products there,
// and coefficients on a coarse grid need transforms of its size only.
class GaussianAtoms {
 public:
  using Coefficients = std::vector<std::vector<double>>;  // per band

  // Throws std::invalid_argument for spacings that do not divide the counts.
  GaussianAtoms(const FrequencyGrid& grid, std::vector<AtomBand> bands);

  const FrequencyGrid& grid() const { return grid_; }
  const std::vector<AtomBand>& bands() const { return bands_; }
  Coefficients zeros() const;

  // The counts of a band's coefficients, whole and as stored.
  Counts3 band_counts(std::size_t band) const;
  // How many stored copies a coefficient has, inverted: 1/2 or 1. A sum with these weights counts each once.
  double weight(std::size_t band, std::size_t index) const { return weights_[band][index]; }
  std::span<const double> weights(std::size_t band) const { return weights_[band]; }
  // Whether none of a coefficient's copies is stored before this one.
  bool is_first_copy(std::size_t band, std::size_t index) const;
  // The frequency of a coefficient in steps of the grid, per axis, from -n/2 to n/2.
  Counts3 frequency_index(std::size_t band, std::size_t index) const;
  // The integral over frequencies of a pair with coefficient 1, divided by the grid's cell.
  double pair_sum(std::size_t band) const { return pair_sums_[band]; }

  // lags = transform of S x, the spectrum with the given coefficients.
  void synthesize(const Coefficients& x, std::vector<double>& lags) const;
  // x = S^T r for the spectrum r with this transform.
  void correlate(std::span<const double> lags, Coefficients& x) const;

  // The transform of a spectrum (all frequencies, last axis fastest, even): R(t), of which R(-t) is the same,
  // with the lags of the first axis from 0 to half of its count.
  std::vector<double> lags_of(std::span<const double> spectrum) const;
  // sum over all frequencies of the product of two spectra.
  double dot(std::span<const double> lags_a, std::span<const double> lags_b) const;

  double dot(const Coefficients& x, const Coefficients& y) const;
  double sum(const Coefficients& x) const;

  // An upper estimate, by at most about 1 %, of the largest eigenvalue of S^T S.
  double norm_squared() const;

 private:
  struct Axis {
    std::vector<double> response;  // transform of h along this axis, scaled
    std::vector<int> used;         // lags at which it is not negligible
    std::vector<int> folded;       // of a lag: modulo the band's count
    std::vector<int> mirrored;     // and of its negative
  };

  void add_band(std::size_t band, std::span<const double> small, std::size_t row,
                std::span<double> lags) const;
  void gather_band(std::size_t band, std::span<const double> lags, std::span<double> small) const;

  FrequencyGrid grid_;
  std::vector<AtomBand> bands_;
  EvenTransform transform_;
  std::vector<EvenTransform> band_transforms_;
  std::vector<std::array<Axis, 3>> axes_;
  std::vector<std::vector<double>> weights_;
  std::vector<std::vector<std::size_t>> own_mirrors_;  // coefficients with w = -w
  std::vector<double> pair_sums_;
};

}  // namespace solidnoise
