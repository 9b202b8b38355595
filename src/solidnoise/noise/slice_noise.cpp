#include "solidnoise/noise/slice_noise.h"

#include <cmath>
#include <vector>

#include "solidnoise/core/quadrature.h"

namespace solidnoise {
namespace {

Samples<4> with_time(const Samples<3>& samples, std::vector<float>& time_gradient) {
  Samples<4> all{samples.values, {}};
  if (samples.wants_gradient()) {
    time_gradient.resize(samples.values.size());
    all.gradient = {samples.gradient[0], samples.gradient[1], samples.gradient[2], time_gradient};
  }
  return all;
}

class SliceBlock final : public FieldBlock<3> {
 public:
  SliceBlock(std::unique_ptr<FieldBlock<4>> block, double t) : block_(std::move(block)), t_(t) {}

  void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
    const Lattice<4> frame{{lattice.origin, t_}, {lattice.step, 1.0}, {lattice.first, 0}, {lattice.count, 1}};
    std::vector<float> time_gradient;
    block_->evaluate(frame, with_time(samples, time_gradient));
  }

 private:
  std::unique_ptr<FieldBlock<4>> block_;
  double t_;
};

class SliceNoise final : public Noise<3> {
 public:
  SliceNoise(std::shared_ptr<const Noise<4>> noise, double t) : noise_(std::move(noise)), t_(t) {}

  using Noise<3>::evaluate;

  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<SliceBlock>(noise_->block({{box.lower, t_}, {box.upper, t_}}), t_);
  }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    std::vector<Vec<4>> at_time;
    at_time.reserve(points.size());
    for (const Vec<3>& position : points.positions) at_time.emplace_back(position, t_);
    std::vector<float> time_gradient;
    noise_->evaluate({at_time}, with_time(samples, time_gradient));
  }

  double variance() const override { return noise_->variance(); }
  Vec<3> gradient_variance() const override { return {noise_->gradient_variance()}; }

  double power_spectrum(const Vec<3>& frequency) const override {
    constexpr int kPanels = 16;
    const double highest = 1.25 * noise_->band().upper;
    return integrate(
        [&](double f) {
          return noise_->power_spectrum({frequency, f});
        },
        -highest, highest, kPanels);
  }

  double excess_kurtosis() const override { return noise_->excess_kurtosis(); }

  // A slice has all lower frequencies.
  Band band() const override { return {0.0, noise_->band().upper}; }

  std::vector<Part> parts() const override {
    std::vector<Part> slices;
    for (const auto& part : noise_->parts()) {
      slices.push_back({std::make_shared<SliceNoise>(part.noise, t_), part.amplitude});
    }
    return slices;
  }

  // At displacements without time, waves differ by their frequencies in space alone.
  WaveMixture<3> waves() const override {
    const WaveMixture<4> all = noise_->waves();
    WaveMixture<3> frame;
    for (const auto& wave : all.waves) frame.waves.push_back({wave.variance, Vec<3>(wave.frequency)});
    if (all.symmetry == WaveMixture<4>::Symmetry::mirror) frame.symmetry = WaveMixture<3>::Symmetry::mirror;
    frame.a = all.a;
    frame.truncation = all.truncation;
    for (const auto& wave : all.truncation_waves) {
      frame.truncation_waves.push_back({wave.variance, Vec<3>(wave.frequency)});
    }
    frame.impulses = all.impulses;
    frame.radius = all.radius;
    return frame;
  }

 private:
  std::shared_ptr<const Noise<4>> noise_;
  double t_;
};

}  // namespace

std::unique_ptr<Noise<3>> slice(std::shared_ptr<const Noise<4>> noise, double t) {
  return std::make_unique<SliceNoise>(std::move(noise), t);
}

}  // namespace solidnoise
