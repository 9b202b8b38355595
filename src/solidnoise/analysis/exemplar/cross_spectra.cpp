#include "solidnoise/analysis/exemplar/cross_spectra.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "solidnoise/analysis/exemplar/exemplar_patches.h"
#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/analysis/fft.h"

namespace solidnoise {
namespace {

using Complex = std::complex<double>;

constexpr int kLargestWhole = 384;  // pixels of a picture that is one patch
constexpr int kPatchOfLarge = 256;

}  // namespace

template <int Dim>
SampleMoments sample_moments(std::span<const Exemplar<Dim>> exemplars) {
  const std::size_t channels = exemplars.front().channels.size();
  SampleMoments result;
  double samples = 0.0;
  for (const Exemplar<Dim>& exemplar : exemplars) samples += static_cast<double>(exemplar.shape().size());
  const auto add = [&](double& total, const auto& term) {
    for (const Exemplar<Dim>& exemplar : exemplars) {
      double sum = 0.0;
      for (std::size_t p = 0; p < exemplar.shape().size(); ++p) sum += term(exemplar, p);
      total += sum / samples;
    }
  };
  result.mean.assign(channels, 0.0);
  result.covariance.assign(channels * channels, 0.0);
  for (std::size_t i = 0; i < channels; ++i) {
    add(result.mean[i],
        [i](const Exemplar<Dim>& exemplar, std::size_t p) { return exemplar.channels[i].values[p]; });
  }
  for (std::size_t i = 0; i < channels; ++i) {
    for (std::size_t j = 0; j < channels; ++j) {
      add(result.covariance[i * channels + j], [&, i, j](const Exemplar<Dim>& exemplar, std::size_t p) {
        return (exemplar.channels[i].values[p] - result.mean[i]) *
               (exemplar.channels[j].values[p] - result.mean[j]);
      });
    }
  }
  return result;
}

template <int Dim>
CrossSpectra<Dim> cross_spectra(std::span<const Exemplar<Dim>> exemplars, int patch, Progress* progress) {
  if (exemplars.empty()) throw std::invalid_argument("there is no exemplar");
  if (patch != 0 && patch < kSmallestPatch) {
    throw std::invalid_argument(
        fmt::format("patch is {}; it must be at least {}, or 0 for none", patch, kSmallestPatch));
  }
  CrossSpectra<Dim> result;
  result.count = exemplars.front().shape().count;
  result.step = exemplars.front().shape().step;
  result.channels = static_cast<int>(exemplars.front().channels.size());
  for (const Exemplar<Dim>& exemplar : exemplars) {
    exemplar.validate("an exemplar");
    if (exemplar.channels.size() != exemplars.front().channels.size()) {
      throw std::invalid_argument("the exemplars are of different kinds: some grey, some in colour");
    }
    if (exemplar.shape().step != result.step) {
      throw std::invalid_argument("the exemplars have samples of different sizes");
    }
    result.count = glm::min(result.count, exemplar.shape().count);
  }
  for (int axis = 0; axis < Dim; ++axis) {
    const bool is_large = patch == 0 && Dim == 2 && result.count[axis] > kLargestWhole;
    const int most = is_large ? kPatchOfLarge : patch;
    if (most != 0) result.count[axis] = std::min(result.count[axis], most);
    result.count[axis] = fast_count(result.count[axis]);
  }

  static_cast<SampleMoments&>(result) = sample_moments(exemplars);
  const auto channels = static_cast<std::size_t>(result.channels);
  result.cross.assign(channels * channels, {});
  for (const Exemplar<Dim>& exemplar : exemplars)
    result.patches += static_cast<int>(patch_origins(exemplar, result.count).size());
  const auto size = static_cast<double>(ArrayShape<Dim>{result.count}.size());
  const std::vector<int> counts(&result.count[0], &result.count[0] + Dim);
  for (std::vector<Complex>& values : result.cross) values.assign(static_cast<std::size_t>(size), 0.0);
  for_each_patch(exemplars, result.count, progress, [&](std::vector<DenseField<Dim>>& fields) {
    std::vector<std::vector<Complex>> transforms;
    for (std::size_t i = 0; i < channels; ++i) {
      for (float& value : fields[i].values) value -= static_cast<float>(result.mean[i]);
      const DenseField<Dim> periodic = periodic_component(fields[i]);
      transforms.push_back(
          fft_of_real(std::vector<double>(periodic.values.begin(), periodic.values.end()), counts));
    }
    for (std::size_t i = 0; i < channels; ++i) {
      for (std::size_t j = 0; j < channels; ++j) {
        std::vector<Complex>& cross = result.cross[i * channels + j];
        for (std::size_t k = 0; k < cross.size(); ++k) {
          cross[k] += std::conj(transforms[i][k]) * transforms[j][k] / (size * result.patches);
        }
      }
    }
  });
  return result;
}

template <int Dim>
PowerSpectrum<Dim> CrossSpectra<Dim>::weighted(std::span<const double> weights) const {
  PowerSpectrum<Dim> result;
  result.count = count;
  result.step = step;
  result.window = Window::none;
  result.independent_blocks = patches;
  result.density.assign(ArrayShape<Dim>{count}.size(), 0.0);
  double cell = 1.0;  // of a sample
  for (int axis = 0; axis < Dim; ++axis) cell *= step[axis];
  for (std::size_t i = 0; i < cross.size(); ++i) {
    for (std::size_t k = 0; k < result.density.size(); ++k) {
      result.density[k] += cell * weights[i] * cross[i][k].real();
    }
  }
  return result;
}

template <int Dim>
PowerSpectrum<Dim> CrossSpectra<Dim>::spectrum(std::span<const double> direction) const {
  std::vector<double> weights;
  for (const double i : direction) {
    for (const double j : direction) weights.push_back(i * j);
  }
  PowerSpectrum<Dim> result = weighted(weights);
  for (double& value : result.density) value = std::max(value, 0.0);
  return result;
}

template <int Dim>
double CrossSpectra<Dim>::variance(std::span<const double> direction) const {
  double sum = 0.0;
  const auto n = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) sum += direction[i] * direction[j] * covariance[i * n + j];
  }
  return std::max(sum, 0.0);
}

template SampleMoments sample_moments<2>(std::span<const Exemplar<2>>);
template SampleMoments sample_moments<3>(std::span<const Exemplar<3>>);
template struct CrossSpectra<2>;
template struct CrossSpectra<3>;
template CrossSpectra<2> cross_spectra<2>(std::span<const Exemplar<2>>, int, Progress*);
template CrossSpectra<3> cross_spectra<3>(std::span<const Exemplar<3>>, int, Progress*);

}  // namespace solidnoise
