#pragma once

#include <span>
#include <string>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

// A power spectrum as a sparse sum of Gaussians, in bands of one width each (Galerne et al. 2012, section 4):
// the description of a noise by example. In n dimensions a component of variance v at the frequency w, in a
// band of Gaussian parameter a, is a pair,
//   v (sqrt2 / a)^n / 2 (exp(-2 pi |f - w|^2 / a^2) + exp(-2 pi |f + w|^2 / a^2)),
// which integrates to v over R^n: w and -w mean the same. In an isotropic spectrum w stands for all vectors
// of its length. Plain data; frequencies and a in cycles per world unit, variances of the noise's value
// squared.
struct SpectrumComponent {
  Vec<3> frequency{0.0};  // axes beyond the spectrum's dimensions are 0
  double variance = 0.0;
  int group = 0;  // index into GaborSpectrum::groups

  friend bool operator==(const SpectrumComponent&, const SpectrumComponent&) = default;
};

struct SpectrumBand {
  double a = 0.0;
  std::vector<SpectrumComponent> components{};

  friend bool operator==(const SpectrumBand&, const SpectrumBand&) = default;
};

struct GaborSpectrum {
  int dimensions = 2;      // 2 or 3
  bool isotropic = false;  // whether components stand for all directions
  std::vector<SpectrumBand> bands{};
  std::vector<std::string> groups{"all"};

  double variance() const;

  // Two-sided power spectral density; axes of `frequency` beyond `dimensions` must be 0.
  double density(const Vec<3>& frequency) const;

  // The spectrum's inverse Fourier transform, the covariance of the values at places `offset` apart (world
  // units).
  double covariance(const Vec<3>& offset) const;

  // The spectrum in other units, in which all frequencies are multiplied by `factor` > 0.
  GaborSpectrum scaled(double factor) const;

  // The spectrum after a filter of the frequency response exp(-pi f^2 / b^2), b > 0: each Gaussian times
  // that squared is a Gaussian again.
  GaborSpectrum filtered(double b) const;

  // Throws std::invalid_argument with the path of what is wrong, such as bands[2].components[7].variance:
  // dimensions, groups, variances; an a or a frequency beyond 1e-16 to 1e16, or beyond 1e-6 to 1e6 times the
  // root mean square frequency.
  void validate() const;

  friend bool operator==(const GaborSpectrum&, const GaborSpectrum&) = default;
};

// What a noise takes over from an exemplar: one spectrum per channel of a decorrelated colour space, and how
// channels make colours: color = mean + sum over k of axes[k] n_k, with n_k the noise of channel k, or the
// squares of these three numbers.
struct ExemplarModel {
  std::vector<GaborSpectrum> channels{};  // 1 (grey) or 3
  std::vector<Vec<3>> axes{Vec<3>(1.0)};  // one per channel: its color
  Vec<3> mean{0.0};                       // linear light, unless the file says that values are raw
  bool raw_values = false;
  bool squares = false;  // the colours are squares, of a mean and axes of their roots

  // Root mean square frequency of all channels together, a component's own width included; it is what scales
  // a model: with b the variance's share, sqrt(sum of b (|w|^2 + n a^2 / (4 pi))).
  double principal_frequency() const;

  // Variances of the three numbers, before they are squared, and the mean of the colours.
  Vec<3> variances() const;
  Vec<3> mean_color() const;

  // Throws std::invalid_argument: as GaborSpectrum::validate, and where numbers or dimensions do not agree.
  void validate() const;

  friend bool operator==(const ExemplarModel&, const ExemplarModel&) = default;
};

// The colors that noises of a model's channels make. Precondition: a valid model.
class ChannelColors {
 public:
  // Of noises of unit variance, or of these variances, where a filter has taken some: the mean of the colours
  // stays then, of squares too.
  explicit ChannelColors(const ExemplarModel& model, std::span<const double> variances = {});

  // One value per channel. Not clamped.
  Vec<3> operator()(std::span<const double> values) const;

 private:
  struct Channel {
    double deviation;
    Vec<3> axis;
  };
  std::vector<Channel> channels_;
  Vec<3> mean_;
  Vec<3> taken_{0.0};  // by the filter, of the squares' mean
  bool squares_;
};

}  // namespace solidnoise
