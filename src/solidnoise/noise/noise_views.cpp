#include "solidnoise/noise/noise_views.h"

#include <utility>
#include <vector>

#include "solidnoise/core/check.h"
#include "solidnoise/noise/same_statistics.h"
#include "solidnoise/noise/section_spectrum.h"

namespace solidnoise {
namespace {

template <int Dim>
class MovedBlock final : public FieldBlock<Dim> {
 public:
  MovedBlock(std::unique_ptr<FieldBlock<Dim>> block, const Vec<Dim>& offset)
      : block_(std::move(block)), offset_(offset) {}

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    Lattice<Dim> moved = lattice;
    moved.origin -= offset_;
    block_->evaluate(moved, samples);
  }

 private:
  std::unique_ptr<FieldBlock<Dim>> block_;
  Vec<Dim> offset_;
};

template <int Dim>
class MovedNoise final : public SameStatistics<Dim> {
 public:
  MovedNoise(std::shared_ptr<const Noise<Dim>> noise, const Vec<Dim>& offset)
      : SameStatistics<Dim>(std::move(noise)), offset_(offset) {}

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return std::make_unique<MovedBlock<Dim>>(this->noise().block({box.lower - offset_, box.upper - offset_}),
                                             offset_);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    std::vector<Vec<Dim>> moved(points.positions.begin(), points.positions.end());
    for (Vec<Dim>& position : moved) position -= offset_;
    this->noise().evaluate({moved}, samples);
  }
  std::vector<typename Noise<Dim>::Part> parts() const override {
    auto parts = this->noise().parts();
    for (auto& part : parts) part.noise = std::make_shared<MovedNoise>(part.noise, offset_);
    return parts;
  }

 private:
  Vec<Dim> offset_;
};

}  // namespace

template <int Dim>
std::unique_ptr<Noise<Dim>> move_noise(std::shared_ptr<const Noise<Dim>> noise, const Vec<Dim>& offset) {
  for (int axis = 0; axis < Dim; ++axis) require_finite("offset", offset[axis]);
  return std::make_unique<MovedNoise<Dim>>(std::move(noise), offset);
}

template std::unique_ptr<Noise<1>> move_noise<1>(std::shared_ptr<const Noise<1>>, const Vec<1>&);
template std::unique_ptr<Noise<2>> move_noise<2>(std::shared_ptr<const Noise<2>>, const Vec<2>&);
template std::unique_ptr<Noise<3>> move_noise<3>(std::shared_ptr<const Noise<3>>, const Vec<3>&);
template std::unique_ptr<Noise<4>> move_noise<4>(std::shared_ptr<const Noise<4>>, const Vec<4>&);

namespace {

Samples<4> with_time(const Samples<3>& samples, std::vector<float>& time_gradient) {
  Samples<4> all{samples.values, {}, samples.gradient_alone};
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
    return section_spectrum(*noise_, [&](double f) { return Vec<4>(frequency, f); });
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

  double covariance(const Vec<3>& displacement) const override {
    return noise_->covariance(Vec<4>(displacement, 0.0));
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
    frame.work = all.work;
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
