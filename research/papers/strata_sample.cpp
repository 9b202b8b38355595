#include "papers/strata_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "solidnoise/core/moments.h"

namespace solidnoise::papers {
namespace {

constexpr int kBatches = 20;

// Samples of a seed, so many along each axis.
template <int Dim>
std::vector<float> values_of(const Noise<Dim>& noise, double step, int side) {
  Lattice<Dim> lattice;
  lattice.step = Vec<Dim>(step);
  lattice.count = glm::vec<Dim, int>(side);
  std::vector<float> values(lattice.size());
  noise.evaluate(lattice, {.values = values});
  return values;
}

// Of the mean square over a window W of a Gaussian field: 2 integral of C(x - y)^2 over W and W / |W|^2.
double gaussian_variance(const Noise<2>& noise, double radius, double side) {
  constexpr int kSteps = 60;
  const double farthest = std::min(2.0 * radius, side);  // beyond, covariances are 0
  const double step = farthest / kSteps;
  double sum = 0.0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double covariance = noise.covariance(Vec<2>(i * step, j * step));
      sum += covariance * covariance * (1.0 - std::abs(i) * step / side) * (1.0 - std::abs(j) * step / side);
    }
  }
  return 2.0 * sum * step * step / (side * side);
}

}  // namespace

Estimate estimate(const std::vector<double>& batches) {
  const auto count = static_cast<double>(batches.size());
  double sum = 0.0;
  for (const double value : batches) sum += value;
  double squares = 0.0;
  for (const double value : batches) squares += std::pow(value - sum / count, 2);
  return {sum / count, std::sqrt(squares / (count * (count - 1.0)))};
}

template <int Dim>
Ensemble measure_ensemble(const MakeNoise<Dim>& make, double spacing, int seeds) {
  constexpr std::array kSide = {4096, 64, 16, 8};
  std::array<std::vector<double>, 5> batches;
  for (int batch = 0; batch < kBatches; ++batch) {
    Moments moments;
    std::uint64_t beyond_3 = 0;
    std::uint64_t beyond_4 = 0;
    for (int seed = batch; seed < seeds; seed += kBatches) {
      const std::vector<float> values =
          values_of<Dim>(*make(static_cast<std::uint64_t>(seed)), spacing, kSide[Dim - 1]);
      moments.merge(Moments::of(values));
      for (const float value : values) {
        beyond_3 += std::abs(value) > 3.0f;
        beyond_4 += std::abs(value) > 4.0f;
      }
    }
    const auto count = static_cast<double>(moments.count());
    const std::array found = {moments.mean(), std::pow(moments.sigma(), 2), moments.excess_kurtosis(),
                              static_cast<double>(beyond_3) / count, static_cast<double>(beyond_4) / count};
    for (std::size_t i = 0; i < found.size(); ++i) batches[i].push_back(found[i]);
  }
  return {estimate(batches[0]), estimate(batches[1]), estimate(batches[2]), estimate(batches[3]),
          estimate(batches[4])};
}

std::vector<WindowPower> measure_windows(const MakeNoise<2>& make, double radius, int seeds) {
  constexpr int kPerRadius = 6;  // samples
  constexpr int kAcross = 32;    // radii
  constexpr int kRow = kAcross * kPerRadius;
  std::vector<WindowPower> result;
  std::vector<std::vector<float>> squares;
  for (int seed = 0; seed < seeds; ++seed) {
    squares.push_back(values_of<2>(*make(static_cast<std::uint64_t>(seed)), radius / kPerRadius, kRow));
  }
  for (int side = 1; side < kAcross; side *= 2) {
    const int samples = side * kPerRadius;
    const double gaussian = gaussian_variance(*make(0), radius, side * radius);
    std::vector<double> batches;
    for (int batch = 0; batch < kBatches; ++batch) {
      // About the mean that is known, 1: of few windows their own would hide a part.
      double sum = 0.0;
      int count = 0;
      for (std::size_t seed = static_cast<std::size_t>(batch); seed < squares.size(); seed += kBatches) {
        for (int window = 0; window < kAcross / side * (kAcross / side); ++window) {
          const int top = window / (kAcross / side) * samples;
          const int left = window % (kAcross / side) * samples;
          double power = 0.0;
          for (int row = top; row < top + samples; ++row) {
            for (int column = left; column < left + samples; ++column) {
              power += std::pow(squares[seed][static_cast<std::size_t>(row * kRow + column)], 2);
            }
          }
          sum += std::pow(power / (samples * samples) - 1.0, 2);
          ++count;
        }
      }
      batches.push_back(sum / count / gaussian);
    }
    result.push_back({static_cast<double>(side), estimate(batches)});
  }
  return result;
}

template Ensemble measure_ensemble<1>(const MakeNoise<1>&, double, int);
template Ensemble measure_ensemble<2>(const MakeNoise<2>&, double, int);
template Ensemble measure_ensemble<3>(const MakeNoise<3>&, double, int);
template Ensemble measure_ensemble<4>(const MakeNoise<4>&, double, int);

}  // namespace solidnoise::papers
