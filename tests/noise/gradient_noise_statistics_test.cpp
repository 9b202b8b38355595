#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/gradient/gradient_noise.h"
#include "support/each_dimension.h"
#include "support/gradient_noises.h"

namespace solidnoise::gradient_noise_statistics_test {
namespace {

using Hash = GradientNoiseOptions::Hash;

// Correlation of the gradients of two lattice points that differ along k axes when the hash is the
// exclusive-or of permutations: -1/255 per axis, because two entries of a permutation differ. (The 256
// gradients sum to 0.)
constexpr double kTableCorrelation = -1.0 / 255.0;

// A mean and its standard error, from values that are independent.
struct Estimate {
  double mean = 0.0;
  double error = 0.0;
};

Estimate estimate(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / count) * (value - sum / count);
  return {sum / count, std::sqrt(squares / (count - 1.0) / count)};
}

// Within 4 standard errors: 6e-5 of false alarms per comparison. `slack` is what is known to differ.
void expect_within_4_sigma(const Estimate& estimated, double expected, double slack = 0.0) {
  EXPECT_NEAR(estimated.mean, expected, 4.0 * estimated.error + slack);
}

// Values at `count` uniformly random positions of a box 2000 lattice units wide, far enough apart to be
// independent but for a few.
template <int Dim>
std::vector<float> scattered_values(const GradientNoise<Dim>& noise, std::size_t count, std::uint64_t key) {
  RandomStream random(key);
  std::vector<Vec<Dim>> positions(count);
  for (int axis = 0; axis < Dim; ++axis) {
    const double width = (Dim == 1 ? 100000.0 : 2000.0) * noise.lattice_spacing()[axis];
    for (Vec<Dim>& position : positions) position[axis] = (random.next_unit() - 0.5) * width;
  }
  std::vector<float> values(count);
  noise.evaluate(Points<Dim>{positions}, Samples<Dim>{values, {}});
  return values;
}

TEST(GradientNoiseStatistics, MeanVarianceAndKurtosisAreTheClosedForms) {
  for_each_dimension([]<int Dim>() {
    for_each_gradient_noise([](GradientNoiseOptions options) {
      // Batches of one seed each: what the seed's table does to the fourth moment is averaged as well.
      constexpr int kBatches = 40;
      std::vector<double> means;
      std::vector<double> variances;
      std::vector<double> fourths;
      for (int batch = 0; batch < kBatches; ++batch) {
        options.seed = static_cast<std::uint64_t>(1000 + batch);
        const GradientNoise<Dim> noise(options);
        double sum = 0.0;
        double squares = 0.0;
        double fourth = 0.0;
        const auto values = scattered_values(noise, 1000, options.seed);
        const double count = static_cast<double>(values.size());
        for (const double value : values) {
          sum += value;
          squares += value * value;
          fourth += value * value * value * value;
        }
        means.push_back(sum / count);
        variances.push_back(squares / count);
        fourths.push_back(fourth / count);
      }
      const GradientNoise<Dim> noise(options);
      // Neighbouring table gradients correlate a little: the variance may differ by 1 %, the fourth moment by
      // 2 %.
      const double slack = options.hash == Hash::xor_tables ? 0.01 : 0.0;
      expect_within_4_sigma(estimate(means), 0.0);
      expect_within_4_sigma(estimate(variances), noise.variance(), slack);
      const double fourth = noise.excess_kurtosis() + 3.0;
      expect_within_4_sigma(estimate(fourths), fourth, 2.0 * slack * fourth);
    });
  });
}

// The terms that meet at a position: sum over pairs of lattice points of their offsets' product, weighted by
// the kernel and by the correlation of their gradients.
template <int Dim>
double variance_with_correlation(const GradientKernel<Dim>& kernel, const Vec<Dim>& x, double correlation) {
  std::vector<Vec<Dim>> points;
  std::vector<Vec<Dim>> terms;
  const int total = 1 << (2 * Dim);
  for (int index = 0; index < total; ++index) {
    Vec<Dim> point;
    double squared = 0.0;
    for (int axis = 0; axis < Dim; ++axis) {
      point[axis] = (index >> (2 * axis)) % 4 - 1;
      squared += (x[axis] - point[axis]) * (x[axis] - point[axis]);
    }
    points.push_back(point);
    terms.push_back((x - point) * kernel.value(std::sqrt(squared)));
  }
  double variance = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      double product = 1.0 / Dim;
      double dot = 0.0;
      for (int axis = 0; axis < Dim; ++axis) {
        if (points[i][axis] != points[j][axis]) product *= correlation;
        dot += terms[i][axis] * terms[j][axis];
      }
      variance += product * dot;
    }
  }
  return variance;
}

TEST(GradientNoiseStatistics, VarianceOverSeedsAtAPositionIsTheClosedForm) {
  for_each_dimension([]<int Dim>() {
    const Vec<4> wanted(0.4, 0.15, 0.7, 0.3);
    for (const Hash hash : {Hash::xor_tables, Hash::integer}) {
      GradientNoiseOptions options;
      options.hash = hash;
      std::vector<double> squares;
      Vec<Dim> x;
      for (int seed = 0; seed < 300; ++seed) {
        options.seed = static_cast<std::uint64_t>(seed);
        const GradientNoise<Dim> noise(options);
        // The position, in 3^n cells that share no lattice point.
        Lattice<Dim> lattice;
        for (int axis = 0; axis < Dim; ++axis) {
          x[axis] = wanted[axis];
          lattice.origin[axis] = x[axis] * noise.lattice_spacing()[axis];
          lattice.step[axis] = 4.0 * noise.lattice_spacing()[axis];
          lattice.first[axis] = -1;
          lattice.count[axis] = 3;
        }
        const auto result = evaluate_in_one_block(noise, lattice);
        double sum = 0.0;
        for (const double value : result.values) sum += value * value;
        squares.push_back(sum / static_cast<double>(lattice.size()));
      }
      const GradientKernel<Dim> kernel(options.kernel);
      const double correlation = hash == Hash::xor_tables ? kTableCorrelation : 0.0;
      const double variance = variance_with_correlation(kernel, x, correlation);
      expect_within_4_sigma(estimate(squares), variance / kernel.mean_variance());
    }
  });
}

// Wave vectors along axes, diagonals and in between, in units of 1/8 cycle per lattice unit.
constexpr std::array<std::array<int, 4>, 14> kWaves = {{{1, 0, 0, 0},
                                                        {0, 2, 0, 0},
                                                        {0, 0, -3, 0},
                                                        {4, 0, 0, 0},
                                                        {0, 0, 0, 5},
                                                        {0, 6, 0, 0},
                                                        {1, 1, 1, 1},
                                                        {2, -2, 0, 0},
                                                        {3, 3, 2, 1},
                                                        {2, 3, -4, 2},
                                                        {1, 5, 2, -1},
                                                        {0, 4, 4, 0},
                                                        {-3, 2, 2, 4},
                                                        {1, 4, -1, 4}}};

// Sums rows of values times phases.
template <typename Value>
std::vector<std::complex<double>> contract(const std::vector<Value>& values,
                                           const std::vector<std::complex<double>>& phases) {
  std::vector<std::complex<double>> sums(values.size() / phases.size());
  const Value* value = values.data();
  for (std::complex<double>& sum : sums) {
    double real = 0.0;
    double imaginary = 0.0;
    for (const std::complex<double>& phase : phases) {
      const std::complex<double> term = phase * std::complex<double>(*value++);
      real += term.real();
      imaginary += term.imag();
    }
    sum = {real, imaginary};
  }
  return sums;
}

// The Fourier coefficient of a periodic field of `side` samples per axis at a wave vector (cycles per
// period).
template <int Dim>
std::complex<double> fourier_coefficient(const std::vector<float>& values, int side,
                                         const std::array<int, 4>& wave) {
  std::vector<std::complex<double>> sums;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    std::vector<std::complex<double>> phases;
    for (int i = 0; i < side; ++i) {
      const double turns = -static_cast<double>(wave[static_cast<std::size_t>(axis)] * i % side) / side;
      phases.push_back(std::polar(1.0 / side, 2.0 * std::numbers::pi * turns));
    }
    // The last axis is summed from the real values, the others from the sums so far.
    if (axis == Dim - 1) {
      sums = contract(values, phases);
    } else {
      sums = contract(sums, phases);
    }
  }
  return sums[0];
}

TEST(GradientNoiseStatistics, SpectrumOfAPeriodIsTheClosedFormInEveryDirection) {
  // Of a periodic field with independent gradients the mean squared Fourier coefficient at k / P is exactly
  // S(k / P) / volume. With tables, the correlation of gradients makes that 256/255 per axis, less 8/255
  // where k is a whole number of cycles per lattice unit along the axis (8 lattice steps per period). 4
  // samples per lattice unit: aliases come from past 3 cycles per unit, where S is below 1e-7 of its peak.
  constexpr int kSteps = 8;
  constexpr int kSide = 4 * kSteps;
  for_each_dimension([]<int Dim>() {
    for (const Hash hash : {Hash::xor_tables, Hash::integer}) {
      GradientNoiseOptions options;
      options.hash = hash;
      options.kernel = GradientNoiseOptions::Kernel::zero_dc;
      const double unit = GradientNoise<Dim>(options).lattice_spacing()[0];
      options.period = Vec<4>(kSteps * unit);
      std::vector<std::vector<double>> ratios(kWaves.size());
      const int seeds = Dim == 4 ? 12 : 120;
      for (int seed = 0; seed < seeds; ++seed) {
        options.seed = static_cast<std::uint64_t>(500 + seed);
        const GradientNoise<Dim> noise(options);
        Lattice<Dim> lattice;
        lattice.step = Vec<Dim>(unit * kSteps / kSide);
        lattice.count = glm::vec<Dim, int>(kSide);
        std::vector<float> values(lattice.size());
        noise.evaluate(lattice, Samples<Dim>{values, {}});
        for (std::size_t w = 0; w < kWaves.size(); ++w) {
          Vec<Dim> frequency;
          double expected = std::pow(kSteps * unit, -Dim);
          for (int axis = 0; axis < Dim; ++axis) {
            const int wave = kWaves[w][static_cast<std::size_t>(axis)];
            frequency[axis] = wave / (kSteps * unit);
            if (hash == Hash::xor_tables) expected *= (256.0 - (wave % kSteps == 0 ? kSteps : 0)) / 255.0;
          }
          expected *= noise.power_spectrum(frequency);
          if (expected == 0.0) continue;  // no wave at all in this dimension
          ratios[w].push_back(std::norm(fourier_coefficient<Dim>(values, kSide, kWaves[w])) / expected);
        }
      }
      for (std::size_t w = 0; w < kWaves.size(); ++w) {
        if (ratios[w].empty()) continue;
        // Each ratio is a chi-square with 2 degrees of freedom, over 2: mean 1, variance 1 (or less in 1D).
        double mean = 0.0;
        for (const double ratio : ratios[w]) mean += ratio / static_cast<double>(ratios[w].size());
        EXPECT_NEAR(mean, 1.0, 4.0 / std::sqrt(static_cast<double>(ratios[w].size()))) << "wave " << w;
      }
    }
  });
}

// Correlation of two sets of values of unit variance.
double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum / static_cast<double>(a.size());
}

TEST(GradientNoiseStatistics, SeedsAreIndependent) {
  for_each_dimension([]<int Dim>() {
    for_each_gradient_noise([](GradientNoiseOptions options) {
      constexpr std::size_t kCount = 8000;
      options.seed = 1;
      const auto first = scattered_values(GradientNoise<Dim>(options), kCount, 5);
      for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{1} << 40}) {
        options.seed = seed;
        const auto second = scattered_values(GradientNoise<Dim>(options), kCount, 5);
        // The products' variance is the mean of the product of the variances at a position: at most 1.6 (1D).
        // Tables have 256 lattice points only in 1D, 128 with half support, worth about 100 independent
        // values.
        const bool repeats = Dim == 1 && options.hash == Hash::xor_tables;
        const double independent = repeats ? 100.0 : static_cast<double>(kCount);
        EXPECT_NEAR(correlation(first, second), 0.0, 4.0 * std::sqrt(1.6 / independent)) << "seed " << seed;
      }
    });
  });
}

TEST(GradientNoiseStatistics, CellsThatShareNoLatticePointAreIndependent) {
  for_each_dimension([]<int Dim>() {
    constexpr int kCount = 2000;
    GradientNoiseOptions options;
    options.hash = Hash::integer;
    const GradientNoise<Dim> noise(options);
    for (int axis = 0; axis < Dim; ++axis) {
      // Pairs 4 lattice units apart along the axis, at random positions.
      RandomStream random(static_cast<std::uint64_t>(axis));
      double sum = 0.0;
      for (int i = 0; i < kCount; ++i) {
        Lattice<Dim> pair;
        for (int a = 0; a < Dim; ++a) pair.origin[a] = 1000.0 * random.next_unit();
        pair.step = 4.0 * noise.lattice_spacing();
        pair.count[axis] = 2;
        std::array<float, 2> values;
        noise.evaluate(pair, Samples<Dim>{values, {}});
        sum += static_cast<double>(values[0]) * values[1];
      }
      // As for seeds.
      EXPECT_NEAR(sum / kCount, 0.0, 4.0 * std::sqrt(1.6 / kCount)) << "axis " << axis;
    }
  });
}

}  // namespace
}  // namespace solidnoise::gradient_noise_statistics_test
