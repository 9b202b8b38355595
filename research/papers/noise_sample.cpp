#include "papers/noise_sample.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>

#include "solidnoise/analysis/expected_spectrum.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"

namespace solidnoise::papers {
namespace {

constexpr double kReach = 5.0;  // of the histogram, standard deviations

// A block of the first M axes of the noise, the others at 0.
template <int Dim, int M>
std::vector<float> values_of(const GaborNoise<Dim>& noise, int side) {
  Lattice<Dim> lattice;
  for (int axis = 0; axis < M; ++axis) lattice.count[axis] = side;
  std::vector<float> values(lattice.size());
  noise.evaluate(lattice, {.values = values});
  return values;
}

// The unit-variance spectrum of an M-dimensional slice as a function of |f|, between a fine table's entries.
template <int Dim, int M>
SpectralDensity<M> slice_density(const GaborNoise<Dim>& noise, double block_length) {
  const IsotropicGaborKernel<Dim>& kernel = noise.kernel();
  const double reach = kernel.frequency() + 4.0 * kernel.a();
  const double step = 1.0 / (16.0 * block_length);
  std::vector<double> table;
  for (double f = 0.0; f < reach + 2.0 * step; f += step) {
    table.push_back(kernel.slice_spectrum(M, f) / kernel.energy());
  }
  const auto density = [table, step](const Vec<M>& frequency) {
    double squared = 0.0;
    for (int axis = 0; axis < M; ++axis) squared += frequency[axis] * frequency[axis];
    const double place = std::sqrt(squared) / step;
    const auto below = static_cast<std::size_t>(place);
    if (below + 1 >= table.size()) return 0.0;
    const double t = place - static_cast<double>(below);
    return (1.0 - t) * table[below] + t * table[below + 1];
  };
  return {density, reach};
}

// What makes the power of all frequencies scatter together: the impulses that a slice sees. One of M
// dimensions sees those within about half a radius of it.
template <int Dim>
ComparisonOptions comparison_options(const GaborNoise<Dim>& noise, int slice_dimensions) {
  const WeightMoments weights = weight_moments(noise.options().weights);
  ComparisonOptions options;
  options.impulse_density = noise.impulse_density() * std::pow(noise.radius(), Dim - slice_dimensions) *
                            weights.second * weights.second / weights.fourth;
  options.kernel_error = noise.options().error;
  return options;
}

class Histogram {
 public:
  explicit Histogram(int bins) : counts_(static_cast<std::size_t>(bins)) {}

  void add(const std::vector<float>& values) {
    for (const float value : values) {
      const double place = (value + kReach) / width();
      ++total_;
      if (place >= 0.0 && place < static_cast<double>(counts_.size())) {
        ++counts_[static_cast<std::size_t>(place)];
      }
    }
  }

  void write(NoiseSample& sample) const {
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
      const double value = (static_cast<double>(bin) + 0.5) * width() - kReach;
      sample.value.push_back(value);
      sample.density.push_back(static_cast<double>(counts_[bin]) / (static_cast<double>(total_) * width()));
      sample.gaussian.push_back(std::exp(-0.5 * value * value) / std::sqrt(2.0 * std::numbers::pi));
    }
  }

 private:
  double width() const { return 2.0 * kReach / static_cast<double>(counts_.size()); }

  std::vector<std::uint64_t> counts_;
  std::uint64_t total_ = 0;
};

template <int M>
glm::vec<M, int> cube(int side) {
  return glm::vec<M, int>(side);
}

}  // namespace

template <int Dim>
NoiseSample sample_noise(const GaborNoiseOptions& options, const SampleSize& size) {
  constexpr int kPlane = std::min(Dim, 2);
  GaborNoiseOptions seeded = options;
  PeriodogramAverage<kPlane> average(cube<kPlane>(size.side), Vec<kPlane>(1.0));
  NoiseSample sample;
  Histogram histogram(size.bins);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int seed = 0; seed < size.seeds; ++seed) {
    seeded.seed = options.seed + static_cast<std::uint64_t>(seed);
    const std::vector<float> values = values_of<Dim, kPlane>(GaborNoise<Dim>(seeded), size.side);
    if (seed == 0) {
      sample.picture = DenseField<2>({size.side, kPlane == 2 ? size.side : 1}, Vec<2>(1.0));
      sample.picture.values = values;
    }
    average.add(values);
    histogram.add(values);
    const Moments moments = Moments::of(values);
    const double mean_square = moments.sigma() * moments.sigma() + moments.mean() * moments.mean();
    sum += mean_square;
    sum_of_squares += mean_square * mean_square;
    sample.moments.merge(moments);
  }
  const double mean = sum / size.seeds;
  sample.variance_error =
      std::sqrt(std::max(0.0, sum_of_squares / size.seeds - mean * mean) / (size.seeds - 1));
  histogram.write(sample);

  const GaborNoise<Dim> noise(options);
  sample.excess_kurtosis = noise.excess_kurtosis();
  sample.impulses = noise.impulses_per_kernel();
  const PowerSpectrum<kPlane> measured = average.spectrum();
  const PowerSpectrum<kPlane> expected = expected_periodogram(slice_density<Dim, kPlane>(noise, size.side),
                                                              measured.count, measured.step, measured.window);
  sample.radial = compare_spectra(measured, expected, comparison_options(noise, kPlane));
  if constexpr (kPlane == 2) {
    sample.estimated = measured;
    sample.expected = expected;
  }
  return sample;
}

template <int Dim>
SpectrumComparison sample_block_spectrum(const GaborNoiseOptions& options, const SampleSize& size) {
  GaborNoiseOptions seeded = options;
  PeriodogramAverage<3> average(cube<3>(size.side), Vec<3>(1.0));
  for (int seed = 0; seed < size.seeds; ++seed) {
    seeded.seed = options.seed + static_cast<std::uint64_t>(seed);
    average.add(values_of<Dim, 3>(GaborNoise<Dim>(seeded), size.side));
  }
  const GaborNoise<Dim> noise(options);
  const PowerSpectrum<3> measured = average.spectrum();
  const PowerSpectrum<3> expected = expected_periodogram(slice_density<Dim, 3>(noise, size.side),
                                                         measured.count, measured.step, measured.window);
  return compare_spectra(measured, expected, comparison_options(noise, 3));
}

template NoiseSample sample_noise<1>(const GaborNoiseOptions&, const SampleSize&);
template NoiseSample sample_noise<2>(const GaborNoiseOptions&, const SampleSize&);
template NoiseSample sample_noise<3>(const GaborNoiseOptions&, const SampleSize&);
template NoiseSample sample_noise<4>(const GaborNoiseOptions&, const SampleSize&);
template SpectrumComparison sample_block_spectrum<3>(const GaborNoiseOptions&, const SampleSize&);
template SpectrumComparison sample_block_spectrum<4>(const GaborNoiseOptions&, const SampleSize&);

}  // namespace solidnoise::papers
