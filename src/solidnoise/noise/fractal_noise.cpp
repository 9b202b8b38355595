#include "solidnoise/noise/fractal_noise.h"

#include <algorithm>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// Overwrites `samples` by the weighted sum of what evaluate(i, buffer) writes for each octave, in order.
template <int Dim, typename Octaves, typename Evaluate>
void sum_octaves(const Octaves& octaves, const Samples<Dim>& samples, const Evaluate& evaluate) {
  if (octaves.empty()) return fill_with_zero(samples);
  const std::size_t count = samples.values.size();
  const int channels = samples.wants_gradient() ? 1 + Dim : 1;
  std::vector<float> memory(count * static_cast<std::size_t>(channels));
  const auto channel = [&](const Samples<Dim>& of, int i) { return i == 0 ? of.values : of.gradient[i - 1]; };
  Samples<Dim> octave{{memory.data(), count}, {}};
  for (int i = 1; i < channels; ++i) {
    octave.gradient[i - 1] = {memory.data() + static_cast<std::size_t>(i) * count, count};
  }

  for (std::size_t k = 0; k < octaves.size(); ++k) {
    evaluate(k, octave);
    const auto amplitude = static_cast<float>(octaves[k].amplitude);
    for (int i = 0; i < channels; ++i) {
      const auto from = channel(octave, i);
      const auto to = channel(samples, i);
      if (k == 0) {
        for (std::size_t j = 0; j < count; ++j) to[j] = amplitude * from[j];
      } else {
        for (std::size_t j = 0; j < count; ++j) to[j] += amplitude * from[j];
      }
    }
  }
}

template <int Dim>
class FractalBlock final : public NoiseBlock<Dim> {
 public:
  struct Octave {
    std::unique_ptr<NoiseBlock<Dim>> block;
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

}  // namespace

void FractalOptions::validate() const {
  require_in_range("octaves", octaves, 1, 16);
  require_in_range("lacunarity", lacunarity, 1.0 + 1e-9, 64.0, "frequency ratio of octaves");
  require_positive("gain", gain, "amplitude ratio of octaves");
}

template <int Dim>
FractalNoise<Dim>::FractalNoise(std::vector<Octave> octaves) : octaves_(std::move(octaves)) {}

template <int Dim>
std::unique_ptr<NoiseBlock<Dim>> FractalNoise<Dim>::block(const Box<Dim>& box) const {
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
