#include "solidnoise/noise/moved_noise.h"

#include <utility>
#include <vector>

#include "solidnoise/core/check.h"

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
class MovedNoise final : public Noise<Dim> {
 public:
  MovedNoise(std::shared_ptr<const Noise<Dim>> noise, const Vec<Dim>& offset)
      : noise_(std::move(noise)), offset_(offset) {}

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return std::make_unique<MovedBlock<Dim>>(noise_->block({box.lower - offset_, box.upper - offset_}),
                                             offset_);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    std::vector<Vec<Dim>> moved(points.positions.begin(), points.positions.end());
    for (Vec<Dim>& position : moved) position -= offset_;
    noise_->evaluate({moved}, samples);
  }
  double variance() const override { return noise_->variance(); }
  Vec<Dim> gradient_variance() const override { return noise_->gradient_variance(); }
  double power_spectrum(const Vec<Dim>& frequency) const override {
    return noise_->power_spectrum(frequency);
  }
  double excess_kurtosis() const override { return noise_->excess_kurtosis(); }
  typename Noise<Dim>::Band band() const override { return noise_->band(); }
  std::vector<typename Noise<Dim>::Part> parts() const override {
    auto parts = noise_->parts();
    for (auto& part : parts) part.noise = std::make_shared<MovedNoise>(part.noise, offset_);
    return parts;
  }
  WaveMixture<Dim> waves() const override { return noise_->waves(); }

 private:
  std::shared_ptr<const Noise<Dim>> noise_;
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

}  // namespace solidnoise
