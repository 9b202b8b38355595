#include "solidnoise/analysis/expected_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace solidnoise::expected_spectrum_test {
namespace {

constexpr double kPi = std::numbers::pi;

// A band of Gaussian shape around +-kBand, unit variance: S(f) = (N(f; kBand) + N(f; -kBand)) / 2, with the
// covariance exp(-2 pi^2 s^2 x^2) cos(2 pi kBand x).
constexpr double kBand = 0.3;
constexpr double kSpread = 0.06;

double band_density(double f) {
  const auto lobe = [](double d) {
    return std::exp(-0.5 * d * d / (kSpread * kSpread)) / (kSpread * std::sqrt(2.0 * kPi));
  };
  return 0.5 * (lobe(f - kBand) + lobe(f + kBand));
}

double band_covariance(double x) {
  return std::exp(-2.0 * kPi * kPi * kSpread * kSpread * x * x) * std::cos(2.0 * kPi * kBand * x);
}

// A noise that knows its spectrum alone.
class KnownSpectrum : public Noise<2> {
 public:
  explicit KnownSpectrum(double stretch) : stretch_(stretch) {}
  std::unique_ptr<FieldBlock<2>> block(const Box<2>&) const override { return nullptr; }
  void evaluate(const Points<2>&, const Samples<2>&) const override {}
  double variance() const override { return 1.0; }
  Vec<2> gradient_variance() const override { return Vec<2>(0.0); }
  double power_spectrum(const Vec<2>& f) const override {
    return band_density(std::hypot(f.x, stretch_ * f.y));
  }
  double excess_kurtosis() const override { return 0.0; }
  Band band() const override { return {0.0, kBand + 4.0 * kSpread}; }

 private:
  double stretch_;
};

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

// The mean of a periodogram from the covariance, by its definition:
//   h / sum w^2 * sum over j, l of w_j w_l R((j - l) h) cos(2 pi k (j - l) / n).
std::vector<double> mean_from_covariance(int n, double step) {
  const std::vector<double> window = window_values(Window::hann, n);
  double energy = 0.0;
  for (const double w : window) energy += w * w;
  std::vector<double> result;
  for (int k = 0; k < n; ++k) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) {
      for (int l = 0; l < n; ++l) {
        sum += window[static_cast<std::size_t>(j)] * window[static_cast<std::size_t>(l)] *
               band_covariance((j - l) * step) * std::cos(2.0 * kPi * k * (j - l) / n);
      }
    }
    result.push_back(sum * step / energy);
  }
  return result;
}

TEST(ExpectedSpectrum, MatchesTheCovariance) {
  const SpectralDensity<1> density{[](const Vec<1>& f) { return band_density(f.x); }, 1.0};
  // Steps 0.5 and 1.3: the band lies under the Nyquist frequency, and across it.
  for (const double step : {0.5, 1.3}) {
    const std::vector<double> expected = mean_from_covariance(80, step);
    const PowerSpectrum<1> spectrum = expected_periodogram<1>(density, glm::vec<1, int>(80), Vec<1>(step));
    // Leakage past 12 frequency steps, some 1e-8 of the power, is left out.
    EXPECT_LT(largest_difference(spectrum.density, expected), 1e-6 * largest(expected)) << step;
  }
}

TEST(ExpectedSpectrum, KeepsTheVarianceInEveryDimension) {
  // A Gaussian: its images and its leakage stay within what is taken.
  const double width = 0.1;
  const SpectralDensity<3> density{[=](const Vec<3>& f) {
                                     const double squared = f.x * f.x + f.y * f.y + f.z * f.z;
                                     return std::exp(-0.5 * squared / (width * width)) /
                                            std::pow(width * std::sqrt(2.0 * kPi), 3);
                                   },
                                   1.0};

  const PowerSpectrum<3> spectrum = expected_periodogram<3>(density, {24, 20, 32}, {1.0, 1.5, 0.7});

  EXPECT_NEAR(spectrum.variance(), 1.0, 1e-5);
}

TEST(ExpectedSpectrum, WithoutAWindowIsTheDensityItself) {
  const SpectralDensity<1> density{[](const Vec<1>& f) { return band_density(f.x); }, 1.0};
  const PowerSpectrum<1> spectrum =
      expected_periodogram<1>(density, glm::vec<1, int>(50), Vec<1>(0.4), Window::none);
  for (std::size_t i = 0; i < spectrum.density.size(); ++i) {
    // Roundings of frequencies, times the steepness; the highest density is 3.
    EXPECT_NEAR(spectrum.density[i], band_density(spectrum.frequency(i).x), 1e-12);
  }
}

TEST(ExpectedSpectrum, OfANoiseIsThatOfItsPowerSpectrum) {
  // Stretch 1 is isotropic, and tabulated; 1.7 is not.
  for (const double stretch : {1.0, 1.7}) {
    const KnownSpectrum noise(stretch);
    const SpectralDensity<2> density{[&](const Vec<2>& f) { return noise.power_spectrum(f); }, 1.0};

    const PowerSpectrum<2> direct = expected_periodogram<2>(density, {48, 40}, {0.6, 0.8});
    const PowerSpectrum<2> spectrum = expected_periodogram<2>(noise, {48, 40}, {0.6, 0.8});

    EXPECT_LT(largest_difference(spectrum.density, direct.density), 1e-6 * largest(direct.density))
        << stretch;
  }
}

// Depends on the components along and across (3, 4) / 5.
class AxialSpectrum : public KnownSpectrum {
 public:
  AxialSpectrum() : KnownSpectrum(1.0) {}
  double power_spectrum(const Vec<2>& f) const override {
    return band_density(std::hypot(0.6 * f.x + 0.8 * f.y, 1.7 * (0.8 * f.x - 0.6 * f.y)));
  }
};

TEST(ExpectedSpectrum, OfAnAxialNoiseMayBeTabulated) {
  const AxialSpectrum noise;
  const PowerSpectrum<2> direct = expected_periodogram<2>(noise, {48, 40}, {0.6, 0.8});

  // The axis need not be of unit length; a wrong one is not used.
  const auto with_axis = [&](const Vec<2>& axis) {
    return expected_periodogram<2>(noise, {48, 40}, {0.6, 0.8}, Window::hann, axis);
  };
  const PowerSpectrum<2> tabulated = with_axis({3.0, 4.0});
  EXPECT_LT(largest_difference(tabulated.density, direct.density), 1e-4 * largest(direct.density));
  EXPECT_NE(tabulated.density, direct.density);
  EXPECT_EQ(with_axis({1.0, 0.0}).density, direct.density);
}

}  // namespace
}  // namespace solidnoise::expected_spectrum_test
