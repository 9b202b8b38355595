#pragma once

#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "solidnoise/core/fields.h"
#include "solidnoise/noise/noise.h"

namespace solidnoise {

// How octaves of a noise are summed: octave k has frequency F lacunarity^k, amplitude gain^k and a seed of
// its own.
struct FractalOptions {
  int octaves = 1;  // 1 to 16
  double lacunarity =
      2.0;            // frequency ratio of consecutive octaves; > 1; a whole number where there is a period
  double gain = 0.5;  // amplitude ratio of consecutive octaves; > 0, at most 16
  bool renormalize = true;  // scale the sum to unit variance, by the closed form

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;

  // Of octave k, over those of octave 0: its frequency, and its amplitude.
  double frequency_ratio(int k) const { return std::pow(lacunarity, k); }
  double amplitude_ratio(int k) const { return std::pow(gain, k); }
  // Of all octaves: the sum of the amplitudes' ratios, and that of their squares.
  double sum_of_ratios() const;
  double power_of_ratios() const;
  // Of each octave in the sum.
  std::vector<double> amplitudes() const;

  // The mean excess kurtosis that octave k may have by itself: as octaves fade, the later ones may be farther
  // from Gaussian, and have fewer impulses. Where the first octave's is within 0.02 so is the sum's, however
  // many there are. It goes in steps with the gain, at 0.55 and 0.85, so that impulses stay where it changes
  // from frame to frame.
  double kurtosis_of_octave(int k, double kurtosis) const;

  friend bool operator==(const FractalOptions&, const FractalOptions&) = default;
};

constexpr auto fields_of(std::type_identity<FractalOptions>) {
  using Options = FractalOptions;
  return list_fields(
      field("octaves", &Options::octaves, between(1, 16), "", "Octaves that are summed"),
      field("lacunarity", &Options::lacunarity, between(1.0 + 1e-9, 64.0), "frequency ratio of octaves",
            "How much finer each octave is than the one before it"),
      field("gain", &Options::gain, Interval{.least = 0.0, .most = 16.0, .without_least = true},
            "amplitude ratio of octaves", "How much weaker each octave is than the one before it"),
      field("renormalize", &Options::renormalize, "Keep the variance at 1, whatever the octaves"));
}

// A weighted sum of independent noises; 0 if there are none. Variances, spectra and fourth cumulants add.
template <int Dim>
class FractalNoise final : public Noise<Dim> {
 public:
  struct Octave {
    std::shared_ptr<const Noise<Dim>> noise;
    double amplitude = 1.0;
  };

  explicit FractalNoise(std::vector<Octave> octaves);

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override;
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override;
  double variance() const override;
  Vec<Dim> gradient_variance() const override;
  double power_spectrum(const Vec<Dim>& frequency) const override;
  double excess_kurtosis() const override;
  typename Noise<Dim>::Band band() const override;
  std::vector<typename Noise<Dim>::Part> parts() const override;

 private:
  std::vector<Octave> octaves_;
};

}  // namespace solidnoise
