#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "solidnoise/analysis/exemplar/cross_spectra.h"
#include "solidnoise/analysis/exemplar/exemplar_channels.h"
#include "solidnoise/analysis/exemplar/exemplar_patches.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/analysis/fft.h"
#include "support/golden.h"

namespace solidnoise::exemplar_statistics_test {
namespace {

// The golden image: 8 x 8, three channels, i the row and j the column.
DenseField<2> golden_channel(int channel) {
  constexpr double p = 1.3;
  constexpr double q = 0.7;
  DenseField<2> field(glm::ivec2(8), Vec<2>(1.0));
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      double value = 0.0;
      if (channel == 0) value = std::sin(p * i + q * j) + 0.1 * i - 0.02 * j * j;
      if (channel == 1) value = std::cos(q * i - p * j) + 0.0125 * i * j;
      if (channel == 2) value = 0.5 * std::sin(p * i + q * j) + std::sin(2.1 * i + 0.3 * j * j);
      field.values[static_cast<std::size_t>(8 * i + j)] = static_cast<float>(value);
    }
  }
  return field;
}

// Fields hold floats: errors of 1e-7 of values up to 4.
constexpr double kFloat = 2e-6;

TEST(PeriodicComponent, MeetsTheGoldenFigures) {
  const nlohmann::json expected = golden("exemplar.json")["periodic_ajd"];
  const DenseField<2> periodic = periodic_component(golden_channel(0));
  double mean = 0.0;
  for (const float value : periodic.values) mean += value / 64.0;
  std::vector<double> centreed;
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(periodic.values[i], expected["periodic_u0"][i / 8][i % 8].get<double>(), kFloat);
    centreed.push_back(periodic.values[i] - mean);
  }
  const auto transform = fft_of_real(centreed, std::array{8, 8});
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(std::norm(transform[i]) / 64.0,
                expected["periodogram_u0_over_size"][i / 8][i % 8].get<double>(), 20.0 * kFloat);
  }
}

// A plane wave that fits into the block is its own periodic component, up to its mean square error; a ramp
// has none but its mean.
TEST(PeriodicComponent, KeepsThePeriodicAndTakesTheRamp) {
  DenseField<3> wave(glm::ivec3(16, 16, 20), Vec<3>(1.0));
  DenseField<3> ramp = wave;
  const ArrayShape<3> shape{wave.count};
  for (std::size_t i = 0; i < wave.size(); ++i) {
    const glm::ivec3 at = shape.position(i);
    ramp.values[i] = 0.1f * static_cast<float>(at.x) - 0.2f * static_cast<float>(at.z);
  }
  const DenseField<3> left = periodic_component(ramp);
  // What is left of a ramp is bounded by its step from one sample to the next, here 0.1 and 0.2, against 1.5
  // and 3.8 from end to end.
  double mean = 0.1 * 7.5 - 0.2 * 9.5;
  for (const float value : left.values) EXPECT_NEAR(value, mean, 0.3);
}

CrossSpectra<2> golden_spectra() {
  CrossSpectra<2> spectra;
  spectra.count = glm::ivec2(8);
  spectra.channels = 3;
  spectra.patches = 1;
  spectra.covariance.assign(9, 0.0);
  std::vector<std::vector<std::complex<double>>> transforms;
  for (int channel = 0; channel < 3; ++channel) {
    const DenseField<2> periodic = periodic_component(golden_channel(channel));
    transforms.push_back(
        fft_of_real(std::vector<double>(periodic.values.begin(), periodic.values.end()), std::array{8, 8}));
    transforms.back()[0] = 0.0;
  }
  for (std::size_t i = 0; i < 9; ++i) {
    std::vector<std::complex<double>>& cross = spectra.cross.emplace_back();
    for (std::size_t k = 0; k < 64; ++k) {
      cross.push_back(std::conj(transforms[i / 3][k]) * transforms[i % 3][k] / 64.0);
      spectra.covariance[i] += cross[k].real() / 64.0;
    }
  }
  return spectra;
}

TEST(ColorAxes, MeetTheGoldenDependences) {
  const nlohmann::json expected = golden("exemplar.json")["periodic_ajd"];
  const CrossSpectra<2> spectra = golden_spectra();
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(spectra.covariance[i], expected["C0"][i / 3][i % 3].get<double>(), kFloat);
  }
  // The paper's J, of channels that are not scaled, along orthogonal axes.
  const auto dependence = [&](const AxisMatrix& axes) {
    double off = 0.0;
    double all = 0.0;
    for (std::size_t p = 0; p < 3; ++p) {
      for (std::size_t q = 0; q < 3; ++q) {
        for (std::size_t k = 0; k < 64; ++k) {
          std::complex<double> sum = 0.0;
          for (std::size_t i = 0; i < 9; ++i) {
            sum += axes[p][static_cast<int>(i / 3)] * axes[q][static_cast<int>(i % 3)] * spectra.cross[i][k];
          }
          all += std::norm(sum);
          if (p != q) off += std::norm(sum);
        }
      }
    }
    return off / all;
  };
  const nlohmann::json j = expected["J_over_norm"];
  EXPECT_NEAR(dependence(color_axes(spectra, ColorAxes::rgb)), j["rgb"].get<double>(), kFloat);
  EXPECT_NEAR(dependence(color_axes(spectra, ColorAxes::pca)), j["pca"].get<double>(), kFloat);
}

// Channels along the axes are uncorrelated at the same point, of any exemplar, and not more dependent than
// along principal axes at others.
TEST(ColorAxes, LeaveTheChannelsUncorrelated) {
  const CrossSpectra<2> spectra = golden_spectra();
  const AxisMatrix axes = color_axes(spectra, ColorAxes::independent);
  const AxisMatrix directions = channel_directions(axes);
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(glm::dot(directions[p], axes[q]), p == q ? 1.0 : 0.0, 1e-9);
      double sum = 0.0;
      double scale = 0.0;
      for (std::size_t i = 0; i < 9; ++i) {
        const double term = directions[p][static_cast<int>(i / 3)] * directions[q][static_cast<int>(i % 3)] *
                            spectra.covariance[i];
        sum += term;
        scale += std::abs(term);
      }
      if (p == q) continue;
      EXPECT_NEAR(sum, 0.0, 1e-9 * scale);
    }
  }
  const auto dependence = [&](ColorAxes kind) {
    return channel_dependence(spectra, channel_directions(color_axes(spectra, kind)));
  };
  EXPECT_LE(dependence(ColorAxes::independent), dependence(ColorAxes::pca));
}

Exemplar<2> wavy_exemplar(const glm::ivec2& count, float offset) {
  Exemplar<2> exemplar;
  exemplar.channels.emplace_back(count, Vec<2>(0.5));
  for (std::size_t i = 0; i < exemplar.channels[0].size(); ++i) {
    exemplar.channels[0].values[i] = offset + std::sin(0.37f * static_cast<float>(i * i % 101));
  }
  return exemplar;
}

TEST(CrossSpectra, HaveTheSamplesMeanAndVariance) {
  const std::vector<Exemplar<2>> exemplars{wavy_exemplar({32, 48}, 2.0f)};
  const CrossSpectra<2> spectra = cross_spectra<2>(exemplars);
  EXPECT_EQ(spectra.count, glm::ivec2(32, 48));
  EXPECT_EQ(spectra.patches, 1);
  double mean = 0.0;
  double squares = 0.0;
  for (const float value : exemplars[0].channels[0].values) {
    mean += value / 1536.0;
    squares += static_cast<double>(value) * value / 1536.0;
  }
  EXPECT_NEAR(spectra.mean[0], mean, 1e-6);
  EXPECT_NEAR(spectra.covariance[0], squares - mean * mean, 1e-5);
  // The spectrum integrates to the periodic component's variance.
  const DenseField<2> periodic = periodic_component(exemplars[0].channels[0]);
  double variance = 0.0;
  for (const float value : periodic.values) variance += (value - mean) * (value - mean) / 1536.0;
  EXPECT_NEAR(spectra.spectrum(std::array{1.0}).variance(), variance, 1e-5);
}

TEST(CrossSpectra, CutExemplarsIntoPatchesOfOneFastSize) {
  // 61 is cut to 60, 37 to 36; the larger exemplar gives 1 + floor(2 (130 - 60) / 60) = 3 by
  // 1 + floor(2 (50 - 36) / 36) = 1 patches.
  const std::vector<Exemplar<2>> exemplars{wavy_exemplar({61, 37}, 0.0f), wavy_exemplar({130, 50}, 1.0f)};
  const CrossSpectra<2> spectra = cross_spectra<2>(exemplars);
  EXPECT_EQ(spectra.count, glm::ivec2(60, 36));
  EXPECT_EQ(spectra.patches, 4);
  EXPECT_EQ(cross_spectra<2>(exemplars, 16).count, glm::ivec2(16));
  EXPECT_THROW(cross_spectra<2>(exemplars, 8), std::invalid_argument);
}

TEST(CrossSpectra, LeaveFewSamplesOut) {
  for (int count = 16; count < 3000; ++count) {
    EXPECT_LE(fast_count(count), count);
    EXPECT_GT(fast_count(count), (count < 100 ? 0.86 : 0.92) * count);
  }
  EXPECT_EQ(fast_count(17), 16);
  EXPECT_EQ(fast_count(128), 128);
}

}  // namespace
}  // namespace solidnoise::exemplar_statistics_test
