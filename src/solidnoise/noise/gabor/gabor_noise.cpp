#include "solidnoise/noise/gabor/gabor_noise.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "solidnoise/core/memo.h"
#include "solidnoise/core/numerics.h"
#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/convolution/impulse_sums.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"
#include "solidnoise/noise/kernel/impulse_statistics.h"
#include "solidnoise/noise/kernel/impulse_strata.h"

namespace solidnoise {
namespace {

GaborNoiseOptions validated(const GaborNoiseOptions& options) {
  options.validate();
  return options;
}

// Draws the weights of impulses, at the time of an evolution.
class WeightDraw {
 public:
  WeightDraw(ImpulseWeights weights, const Evolution& evolution) : weights_(weights) {
    if (evolution.moves()) turning_.emplace(evolution);
  }

  float operator()(std::uint64_t mark) const {
    return static_cast<float>(turning_ ? at_rest(mark) * (*turning_)(mark) : at_rest(mark));
  }

 private:
  double at_rest(std::uint64_t mark) const {
    if (weights_ == ImpulseWeights::signs) return 2.0 * static_cast<double>(mark >> 63) - 1.0;
    constexpr double kHalfRange =
        0x1.0p52;  // of 53 bits, taken at the middle of each step so that the mean is 0
    return (static_cast<double>(mark >> 11) + 0.5 - kHalfRange) / kHalfRange;
  }

  ImpulseWeights weights_;
  std::optional<TurningFactor> turning_;
};

// An isotropic kernel times a random weight.
class WeightedKernel final : public ImpulseKernel {
 public:
  WeightedKernel(RadialSum sum, const WeightDraw& weight) : sum_(std::move(sum)), weight_(weight) {}

  CullBox::Support support() const override { return CullBox::Support::ball; }
  int attribute_count() const override { return 1; }

  void draw(std::span<const std::uint64_t> marks, ImpulseAttributes& attributes) const override {
    for (std::size_t i = 0; i < marks.size(); ++i) attributes[0][i] = weight_(marks[i]);
  }

  void sum(const ImpulseList& list, const SampleBrick& brick, Derivatives derivatives,
           BrickSums& sums) const override {
    sum_radial(sum_, list, brick, derivatives, sums);
  }
  void sum(const ImpulseList& list, const SampleCluster& cluster, Derivatives derivatives,
           ClusterSums& sums) const override {
    sum_radial(sum_, list, cluster, derivatives, sums);
  }

 private:
  RadialSum sum_;
  WeightDraw weight_;
};

}  // namespace

template <int Dim>
float GaborNoise<Dim>::weight(std::uint64_t mark) const {
  return WeightDraw(options_.weights, options_.evolution)(mark);
}

namespace {

// What noises share that differ in seed, time or filter alone, as the parts of a warp do and pictures of one
// noise after the other: it takes milliseconds to find.
template <int Dim>
struct GaborSetting {
  CompactKernel compact;
  ImpulseLayout<Dim> layout;
  double impulses;  // per kernel
};

WeightMoments moments_of_weights(const GaborNoiseOptions& options) {
  const WeightMoments at_rest = weight_moments(options.weights);
  return options.evolution.moves() ? turning(at_rest) : at_rest;
}

template <int Dim>
std::shared_ptr<const GaborSetting<Dim>> setting_of(const IsotropicGaborKernel<Dim>& kernel,
                                                    const GaborNoiseOptions& options) {
  const WeightMoments weights = moments_of_weights(options);
  GaborNoiseOptions shared = options;
  shared.seed = 0;
  shared.evolution = {};
  shared.filter = 0.0;
  thread_local Memo<std::pair<GaborNoiseOptions, double>, GaborSetting<Dim>> known;
  return known.get({shared, weights.fourth}, [&] {
    const CompactKernel compact = compact_kernel(kernel, options.error, options.bounds_gradient);
    // Impulses are those of unlimited kernels.
    StrataChoice choice = strata_choice(kernel, weights);
    choice.kurtosis = options.kurtosis;
    const ImpulseLayout<Dim> layout =
        make_layout<Dim>(choice, solidnoise::impulse_density(Dim, options.impulses, choice.radius),
                         options.impulses_process, compact.radius(), options.period);
    return GaborSetting<Dim>{compact, layout, impulses_in_ball(Dim, layout.density, choice.radius)};
  });
}

}  // namespace

template <int Dim>
GaborNoise<Dim>::GaborNoise(const GaborNoiseOptions& options)
    : options_(validated(options)),
      kernel_(IsotropicGaborKernel<Dim>::with_unit_peak(
          options.frequency, gaussian_parameter(options.frequency, options.bandwidth))),
      compact_(setting_of(kernel_, options)->compact) {
  // Impulses and amplitude are those of the noise before it is filtered.
  const std::shared_ptr<const GaborSetting<Dim>> setting = setting_of(kernel_, options);
  const ImpulseLayout<Dim>& layout = setting->layout;
  unfiltered_energy_ = compact_.energy();
  density_ = layout.density;
  impulses_ = setting->impulses;
  const WeightMoments weights = moments_of_weights(options);
  const double amplitude = 1.0 / std::sqrt(noise_variance(density_, unfiltered_energy_, weights));
  std::shared_ptr<const ImpulseKernel> kernel;
  if (options.filter == 0.0 || filter_kernel()) {
    variance_ = compact_.energy() / unfiltered_energy_;
    if (layout.count.is_fixed) cubes_ = layout.cubes();
    kernel =
        std::make_shared<WeightedKernel>(RadialSum{support_scale<Dim>(layout.in_cells(compact_.radius())),
                                                   to_single_precision(compact_, RadialSum::kMostDegree)},
                                         WeightDraw(options.weights, options.evolution));
  }
  convolution_ = std::make_shared<SparseConvolution<Dim>>(
      ImpulseProcess<Dim>(layout.axes, layout.count, derive_seed(options.seed, kImpulseStream)), kernel,
      layout.in_cells(compact_.radius()), amplitude);
}

// Puts the filtered kernel in the place of the kernel; false, and no change, if nothing is left of it.
template <int Dim>
bool GaborNoise<Dim>::filter_kernel() {
  const IsotropicGaborKernel<Dim> filtered = kernel_.filtered(filter_bandwidth(options_.filter));
  const FilteredShare share{std::sqrt(filtered.energy() / kernel_.energy()), kernel_.a() / filtered.a()};
  if (share.nothing(options_.error)) return false;
  kernel_ = filtered;
  compact_ = solidnoise::compact_kernel(filtered, share.error(options_.error), options_.bounds_gradient);
  return true;
}

// A compact kernel is about as steep as it is smooth at its end: it has no higher frequencies than this.
template <int Dim>
RadialAverages GaborNoise<Dim>::averages() const {
  return RadialAverages::of(
      Dim, [this](double r) { return std::pow(compact_.value(r), 2); }, compact_.radius(),
      2.0 * kernel_.frequency() + 3.2 * kernel_.a());
}

template <int Dim>
double GaborNoise<Dim>::excess_kurtosis() const {
  if (variance_ == 0.0) return 0.0;
  KernelMoments moments{compact_.energy(), compact_.fourth_moment()};
  if (cubes_.side > 0.0) moments.overlap = averages().overlap(cubes_);
  return noise_excess_kurtosis(density_, moments, moments_of_weights(options_));
}

template <int Dim>
double GaborNoise<Dim>::kurtosis_given_place() const {
  if (variance_ == 0.0 || cubes_.side == 0.0) return 0.0;
  const KernelMoments moments{compact_.energy(), compact_.fourth_moment()};
  return solidnoise::kurtosis_given_place(density_, moments, averages(), cubes_);
}

template <int Dim>
Vec<Dim> GaborNoise<Dim>::gradient_variance() const {
  return Vec<Dim>(variance() * compact_.gradient_energy() / (Dim * compact_.energy()));
}

template <int Dim>
double GaborNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  const double spectrum = compact_.spectrum(glm::length(frequency));
  return variance_ == 0.0 ? 0.0 : spectrum * spectrum / unfiltered_energy_;
}

template <int Dim>
typename Noise<Dim>::Band GaborNoise<Dim>::band() const {
  if (variance_ == 0.0) return {};
  const auto density = [this](double f) { return std::pow(f, Dim - 1) * std::pow(kernel_.spectrum(f), 2); };
  return radial_band<Dim>(density, kernel_.frequency(), kernel_.a());
}

// The waves below are for distances of a few of them.
template <int Dim>
double GaborNoise<Dim>::covariance(const Vec<Dim>& displacement) const {
  return variance_ == 0.0 ? 0.0
                          : variance_ * kernel_.autocorrelation(glm::length(displacement)) / kernel_.energy();
}

// A quadrature of the radial density of variance, S_n f^(n-1) G(f)^2, and of that of the difference that
// making the kernel compact makes, of which about half is at frequencies above the band.
template <int Dim>
WaveMixture<Dim> GaborNoise<Dim>::waves() const {
  WaveMixture<Dim> mixture;
  if (variance_ == 0.0) return mixture;
  mixture.symmetry = WaveMixture<Dim>::Symmetry::mirror;
  mixture.impulses = impulses_in_ball(Dim, density_, compact_.radius());
  mixture.radius = compact_.radius();
  mixture.work = std::max(1.0, (compact_.degree() + 2) / 8.0);  // measured at degrees of 6 to 92
  mixture.truncation = variance_ * std::pow(compact_.relative_error(), 2);
  const auto directions = mirrored_directions<Dim>();
  const QuadratureRule& rule = panel_rule();
  const auto add_shells = [&](std::vector<typename WaveMixture<Dim>::Wave>& waves, double lower, double upper,
                              const auto& transform) {
    const double half = 0.5 * (upper - lower);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double f = lower + half * (1.0 + rule.nodes[i]);
      const double shell = half * rule.weights[i] * unit_sphere_area(Dim) * std::pow(f, Dim - 1) *
                           std::pow(transform(f), 2) / kernel_.energy();
      for (const auto& [direction, weight] : directions) {
        waves.push_back({variance_ * shell * weight, f * direction});
      }
    }
  };
  constexpr double kHalfWidth = 2.0;  // of the band, in a: exp(-2 pi 2^2) of the power is left there
  const double lowest = std::max(0.0, kernel_.frequency() - kHalfWidth * kernel_.a());
  const double highest = kernel_.frequency() + kHalfWidth * kernel_.a();
  add_shells(mixture.waves, lowest, highest, [this](double f) { return kernel_.spectrum(f); });
  const auto difference = [this](double f) { return compact_.spectrum(f) - kernel_.spectrum(f); };
  add_shells(mixture.truncation_waves, 0.0, highest, difference);
  add_shells(mixture.truncation_waves, highest, 2.0 * highest, difference);
  return mixture;
}

template class GaborNoise<1>;
template class GaborNoise<2>;
template class GaborNoise<3>;
template class GaborNoise<4>;

}  // namespace solidnoise
