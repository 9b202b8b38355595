#include "solidnoise/noise/fractal_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

namespace solidnoise {
namespace {

// Calls visit(values, other's values) for all channels of samples.
template <int Dim, typename Visit>
void for_each_channel(const Samples<Dim>& samples, const Samples<Dim>& other, const Visit& visit) {
  visit(samples.values, other.values);
  if (!samples.wants_gradient()) return;
  for (int axis = 0; axis < Dim; ++axis) visit(samples.gradient[axis], other.gradient[axis]);
}

// Overwrites `samples` by the weighted sum of what evaluate(i, buffer) writes for each octave, in order.
template <int Dim, typename Octaves, typename Evaluate>
void sum_octaves(const Octaves& octaves, const Samples<Dim>& samples, const Evaluate& evaluate) {
  if (octaves.empty()) return fill_with_zero(samples);
  evaluate(0, samples);
  const auto first = static_cast<float>(octaves[0].amplitude);
  if (first != 1.0f) {
    for_each_channel(samples, samples, [&](std::span<float> values, std::span<float>) {
      for (float& value : values) value *= first;
    });
  }
  if (octaves.size() == 1) return;

  const SampleBuffer<Dim> octave(samples);
  for (std::size_t k = 1; k < octaves.size(); ++k) {
    evaluate(k, octave.samples());
    const auto amplitude = static_cast<float>(octaves[k].amplitude);
    for_each_channel(samples, octave.samples(), [&](std::span<float> to, std::span<float> from) {
      for (std::size_t j = 0; j < to.size(); ++j) to[j] += amplitude * from[j];
    });
  }
}

template <int Dim>
class FractalBlock final : public FieldBlock<Dim> {
 public:
  struct Octave {
    std::unique_ptr<FieldBlock<Dim>> block;
    double amplitude;
  };

  explicit FractalBlock(std::vector<Octave> octaves) : octaves_(std::move(octaves)) {}

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    sum_octaves<Dim>(octaves_, samples, [&](std::size_t k, const Samples<Dim>& octave) {
      octaves_[k].block->evaluate(lattice, octave);
    });
  }

 private:
  std::vector<Octave> octaves_;
};

// The excess kurtosis that octaves after the first may have where the gain is at most `gain`. With g its
// square the first of two has 1 / (1 + g) of their variance, and with more of them it is better: the sum's
// kurtosis is at most (kMeanKurtosis + kurtosis g^2) / (1 + g)^2.
struct Fading {
  double gain;
  double kurtosis;
};
constexpr std::array kFadings{Fading{0.55, 0.15}, Fading{0.85, 0.075}};

}  // namespace

void FractalOptions::validate() const {
  require_fields(*this);
}

double FractalOptions::sum_of_ratios() const {
  double sum = 0.0;
  for (int k = 0; k < octaves; ++k) sum += amplitude_ratio(k);
  return sum;
}

double FractalOptions::power_of_ratios() const {
  double sum = 0.0;
  for (int k = 0; k < octaves; ++k) sum += amplitude_ratio(2 * k);
  return sum;
}

std::vector<double> FractalOptions::amplitudes() const {
  const double scale = renormalize ? 1.0 / std::sqrt(power_of_ratios()) : 1.0;
  std::vector<double> all;
  for (int k = 0; k < octaves; ++k) all.push_back(scale * amplitude_ratio(k));
  return all;
}

double FractalOptions::kurtosis_of_octave(int k, double kurtosis) const {
  if (k == 0) return kurtosis;
  const auto fading = std::ranges::find_if(kFadings, [this](const Fading& one) { return gain <= one.gain; });
  return fading == kFadings.end() ? kurtosis : std::max(kurtosis, fading->kurtosis);
}

template <int Dim>
FractalNoise<Dim>::FractalNoise(std::vector<Octave> octaves) : octaves_(std::move(octaves)) {}

template <int Dim>
std::unique_ptr<FieldBlock<Dim>> FractalNoise<Dim>::block(const Box<Dim>& box) const {
  std::vector<typename FractalBlock<Dim>::Octave> blocks;
  for (const Octave& octave : octaves_) blocks.push_back({octave.noise->block(box), octave.amplitude});
  return std::make_unique<FractalBlock<Dim>>(std::move(blocks));
}

template <int Dim>
void FractalNoise<Dim>::evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const {
  sum_octaves<Dim>(octaves_, samples, [&](std::size_t k, const Samples<Dim>& octave) {
    octaves_[k].noise->evaluate(points, octave);
  });
}

template <int Dim>
double FractalNoise<Dim>::variance() const {
  double sum = 0.0;
  for (const Octave& octave : octaves_) sum += octave.amplitude * octave.amplitude * octave.noise->variance();
  return sum;
}

template <int Dim>
Vec<Dim> FractalNoise<Dim>::gradient_variance() const {
  Vec<Dim> sum(0.0);
  for (const Octave& octave : octaves_) {
    sum += octave.amplitude * octave.amplitude * octave.noise->gradient_variance();
  }
  return sum;
}

template <int Dim>
double FractalNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  double sum = 0.0;
  for (const Octave& octave : octaves_) {
    sum += octave.amplitude * octave.amplitude * octave.noise->power_spectrum(frequency);
  }
  return sum;
}

template <int Dim>
double FractalNoise<Dim>::excess_kurtosis() const {
  if (octaves_.empty()) return 0.0;
  double fourth_cumulant = 0.0;
  for (const Octave& octave : octaves_) {
    const double variance = octave.amplitude * octave.amplitude * octave.noise->variance();
    fourth_cumulant += octave.noise->excess_kurtosis() * variance * variance;
  }
  return fourth_cumulant / (variance() * variance());
}

template <int Dim>
typename Noise<Dim>::Band FractalNoise<Dim>::band() const {
  if (octaves_.empty()) return {};
  auto band = octaves_.front().noise->band();
  for (const Octave& octave : octaves_) {
    const auto other = octave.noise->band();
    band.lower = std::min(band.lower, other.lower);
    band.upper = std::max(band.upper, other.upper);
  }
  return band;
}

template <int Dim>
std::vector<typename Noise<Dim>::Part> FractalNoise<Dim>::parts() const {
  std::vector<typename Noise<Dim>::Part> all;
  for (const Octave& octave : octaves_) {
    const auto inner = octave.noise->parts();
    if (inner.empty()) all.push_back({octave.noise, octave.amplitude});
    for (const auto& part : inner) all.push_back({part.noise, octave.amplitude * part.amplitude});
  }
  return all;
}

template class FractalNoise<1>;
template class FractalNoise<2>;
template class FractalNoise<3>;
template class FractalNoise<4>;

}  // namespace solidnoise
