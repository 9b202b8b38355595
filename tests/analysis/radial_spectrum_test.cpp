#include "solidnoise/analysis/radial_spectrum.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "analysis/synthetic_fields.h"
#include "solidnoise/analysis/expected_spectrum.h"
#include "support/welch_spectrum.h"

namespace solidnoise::radial_spectrum_test {
namespace {

constexpr double kPi = std::numbers::pi;

// Chi-square summed over independent trials: twice the degrees of freedom is its variance, if the bins' means
// are Gaussian. They are a little skewed (gamma), which widens it; 5 standard deviations are allowed, on both
// sides, so that errors which are taken too large are found as well.
class ChiSquareSum {
 public:
  void add(const SpectrumComparison& comparison) {
    sum_ += comparison.chi_square;
    degrees_ += comparison.degrees_of_freedom;
  }
  double excess_in_sigmas() const { return (sum_ - degrees_) / std::sqrt(2.0 * degrees_); }
  void expect_plausible() const {
    EXPECT_GT(degrees_, 100);
    EXPECT_LT(std::abs(excess_in_sigmas()), 5.0);
  }

 private:
  double sum_ = 0.0;
  int degrees_ = 0;
};

TEST(RadialSpectrum, OfWhiteNoiseIsFlatInEveryDimension) {
  ChiSquareSum sum;
  const auto add = [&sum]<int Dim>(const glm::vec<Dim, int>& size, const glm::vec<Dim, int>& block,
                                   const Vec<Dim>& step, std::uint64_t seed) {
    double flat = 1.0;
    for (int axis = 0; axis < Dim; ++axis) flat *= step[axis];
    PowerSpectrum<Dim> expected;
    expected.count = block;
    expected.step = step;
    expected.density.assign(ArrayShape<Dim>{block}.size(), flat);
    sum.add(compare_spectra(welch_spectrum(white_field<Dim>(size, step, seed), block), expected));
  };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    add(glm::vec<1, int>(32768), glm::vec<1, int>(128), Vec<1>(0.25), seed);
    add(glm::ivec2(128, 160), glm::ivec2(64, 64), Vec<2>(0.5, 0.25), seed);
    add(glm::ivec3(48, 32, 48), glm::ivec3(32, 32, 32), Vec<3>(1.0, 1.0, 2.0), seed);
  }
  sum.expect_plausible();
}

TEST(RadialSpectrum, OfAnAutoregressiveProcessMatchesItsClosedForm) {
  // x_t = a x_(t-1) + e_t has, per sampling step h, the density h / |1 - a exp(-2 pi i f h)|^2, already
  // folded.
  constexpr double kA = 0.8;
  constexpr double kStep = 0.5;
  // Being folded, it is cut at the Nyquist frequency 1, which two images share.
  const auto folded = [=](const Vec<1>& f) {
    const double share = std::abs(f.x) == 1.0 ? 0.5 : 1.0;
    return share * kStep / std::norm(1.0 - kA * std::polar(1.0, -2.0 * kPi * f.x * kStep));
  };
  const SpectralDensity<1> density{folded, 1.0};
  const PowerSpectrum<1> expected = expected_periodogram<1>(density, glm::vec<1, int>(256), Vec<1>(kStep));
  ChiSquareSum sum;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    DenseField<1> field = white_field<1>(glm::vec<1, int>(40000), Vec<1>(kStep), seed);
    for (std::size_t i = 1; i < field.values.size(); ++i) {
      field.values[i] += static_cast<float>(kA) * field.values[i - 1];
    }
    field.values.erase(field.values.begin(), field.values.begin() + 200);  // until it is stationary
    field.count.x -= 200;
    sum.add(compare_spectra(welch_spectrum(field, glm::vec<1, int>(256)), expected));
  }
  sum.expect_plausible();
}

// A ring in the plane: band-pass, isotropic.
double ring_density(double f) {
  const double d = (f - 0.2) / 0.03;
  return std::exp(-0.5 * d * d);
}

PowerSpectrum<2> expected_ring(double scale) {
  const SpectralDensity<2> density{
      [=](const Vec<2>& f) { return ring_density(scale * std::hypot(f.x, f.y)); }, 0.5};
  return expected_periodogram<2>(density, {64, 64}, {1.0, 1.0});
}

DenseField<2> ring_field(std::uint64_t seed) {
  return gaussian_field<2>([](const Vec<2>& f) { return ring_density(std::hypot(f.x, f.y)); }, 256,
                           {224, 192}, {1.0, 1.0}, seed);
}

TEST(RadialSpectrum, OfABandOfGaussianNoiseMatchesItsClosedForm) {
  const PowerSpectrum<2> expected = expected_ring(1.0);
  ChiSquareSum sum;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    sum.add(compare_spectra(welch_spectrum(ring_field(seed), {64, 64}), expected));
  }
  sum.expect_plausible();
}

TEST(RadialSpectrum, ADifferentBandIsRecognised) {
  const SpectrumComparison right =
      compare_spectra(welch_spectrum(ring_field(1), {64, 64}), expected_ring(1.0));
  const SpectrumComparison wrong =
      compare_spectra(welch_spectrum(ring_field(1), {64, 64}), expected_ring(1.03));
  EXPECT_GT(right.significance, 1e-4);
  EXPECT_LT(wrong.significance, 1e-9);
}

// Few impulses: Gaussian kernels exp(-pi a^2 r^2) with weights +-1, whose transform is exp(-pi f^2 / a^2) /
// a^2.
TEST(RadialSpectrum, OfSparseImpulsesScattersAsTheirNumberDoes) {
  constexpr double kA = 0.25;
  constexpr double kDensity = 0.02;
  constexpr int kSize = 64;
  const SpectralDensity<2> density{[](const Vec<2>& f) {
                                     return kDensity / std::pow(kA, 4) *
                                            std::exp(-2.0 * kPi * (f.x * f.x + f.y * f.y) / (kA * kA));
                                   },
                                   1.0};
  const PowerSpectrum<2> expected = expected_periodogram<2>(density, {kSize, kSize}, {1.0, 1.0});

  ChiSquareSum sum;
  ChiSquareSum as_if_gaussian;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    DenseField<2> field({kSize, kSize}, {1.0, 1.0});
    RandomStream stream(mix_bits(seed + 100));
    // A Poisson process: distances along the area's enumeration are exponential. The margin is 10 units.
    constexpr double kMargin = 10.0;
    constexpr double kExtent = kSize + 2.0 * kMargin;
    for (double area = 0.0;;) {
      area -= std::log(1.0 - stream.next_unit()) / kDensity;
      const double x = stream.next_unit() * kExtent - kMargin;
      const double y = stream.next_unit() * kExtent - kMargin;
      const float sign = stream.next_unit() < 0.5 ? -1.0f : 1.0f;
      if (area > kExtent * kExtent) break;
      for (int i = 0; i < kSize; ++i) {
        for (int j = 0; j < kSize; ++j) {
          const double squared = (i - x) * (i - x) + (j - y) * (j - y);
          field.values[static_cast<std::size_t>(i * kSize + j)] +=
              sign * static_cast<float>(std::exp(-kPi * kA * kA * squared));
        }
      }
    }
    const PowerSpectrum<2> measured = periodogram(field);
    sum.add(compare_spectra(measured, expected, {.impulse_density = kDensity, .largest_error = 0.3}));
    as_if_gaussian.add(compare_spectra(measured, expected, {.largest_error = 0.3}));
  }
  sum.expect_plausible();
  EXPECT_GT(as_if_gaussian.excess_in_sigmas(), 5.0);
}

TEST(RadialSpectrum, RefusesSpectraThatDoNotFit) {
  const DenseField<1> field = white_field<1>(glm::vec<1, int>(64), Vec<1>(1.0), 1);
  const PowerSpectrum<1> a = welch_spectrum(field, glm::vec<1, int>(32));
  const PowerSpectrum<1> b = welch_spectrum(field, glm::vec<1, int>(16));
  EXPECT_THROW(compare_spectra(a, b), std::invalid_argument);
  EXPECT_THROW(radial_average(a, -1.0), std::invalid_argument);
}

TEST(RadialSpectrum, BinsHoldEveryFrequencyBelowNyquistOnce) {
  const DenseField<3> field = white_field<3>({16, 16, 16}, {1.0, 1.0, 1.0}, 1);
  std::int64_t expected = 0;
  const PowerSpectrum<3> spectrum = periodogram(field);
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    const Vec<3> f = spectrum.frequency(i);
    if (f.x * f.x + f.y * f.y + f.z * f.z < 0.25) ++expected;
  }

  std::int64_t counted = 0;
  for (const RadialBin& bin : radial_average(spectrum)) {
    counted += bin.count;
    EXPECT_GE(bin.frequency, bin.lower);
    EXPECT_LT(bin.frequency, bin.upper);
  }
  EXPECT_EQ(counted, expected);
}

TEST(ChiSquareSignificance, MatchesTheTables) {
  // Upper 5 % and 1 % points of the distribution.
  EXPECT_NEAR(chi_square_significance(7.815, 3), 0.05, 0.002);
  EXPECT_NEAR(chi_square_significance(11.345, 3), 0.01, 0.002);
  EXPECT_NEAR(chi_square_significance(31.410, 20), 0.05, 0.002);
  EXPECT_NEAR(chi_square_significance(135.807, 100), 0.01, 0.002);
  EXPECT_EQ(chi_square_significance(1.0, 0), 1.0);
}

}  // namespace
}  // namespace solidnoise::radial_spectrum_test
