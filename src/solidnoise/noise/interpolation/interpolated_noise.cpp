#include "solidnoise/noise/interpolation/interpolated_noise.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"

namespace solidnoise {
namespace {

// A noise on one lattice; what of it is not interpolated is evaluated directly.
template <int Dim>
struct Interpolation {
  std::shared_ptr<const Noise<Dim>> noise;
  LatticeFrame<Dim> frame;
  std::optional<LatticeInterpolation<Dim>> values;
  std::optional<LatticeInterpolation<Dim>> gradient;

  bool applies_to(const Lattice<Dim>& lattice) const {
    return lattice.origin == frame.origin && lattice.step == frame.step;
  }
};

template <int Dim>
class InterpolatedBlock final : public FieldBlock<Dim> {
 public:
  InterpolatedBlock(std::shared_ptr<const Interpolation<Dim>> interpolation, const Box<Dim>& box)
      : interpolation_(std::move(interpolation)), box_(box) {}

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    require_room(samples, lattice.size());
    const bool applies = interpolation_->applies_to(lattice);
    const bool values = applies && interpolation_->values;
    const bool gradient = applies && samples.wants_gradient() && interpolation_->gradient;
    if (!gradient && samples.wants_gradient()) {
      evaluate_directly(lattice, samples);
    } else if (!values) {
      evaluate_directly(lattice, {samples.values, {}});
    }
    if (values) made(values_, interpolation_->values).values(lattice, samples.values);
    if (gradient) made(gradient_, interpolation_->gradient).gradient(lattice, samples.gradient);
  }

 private:
  using Interpolator = std::optional<LatticeInterpolator<Dim>>;

  void evaluate_directly(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const {
    if (!direct_) direct_ = interpolation_->noise->block(box_);
    direct_->evaluate(lattice, samples);
  }

  LatticeInterpolator<Dim>& made(Interpolator& interpolator,
                                 const std::optional<LatticeInterpolation<Dim>>& interpolation) const {
    if (!interpolator) interpolator.emplace(*interpolation, box_);
    return *interpolator;
  }

  std::shared_ptr<const Interpolation<Dim>> interpolation_;
  Box<Dim> box_;
  // Made when they are first needed: a block belongs to one thread.
  mutable std::unique_ptr<FieldBlock<Dim>> direct_;
  mutable Interpolator values_;
  mutable Interpolator gradient_;
};

template <int Dim>
class InterpolatedNoise final : public Noise<Dim> {
 public:
  explicit InterpolatedNoise(std::shared_ptr<const Interpolation<Dim>> interpolation)
      : interpolation_(std::move(interpolation)), noise_(*interpolation_->noise) {}

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return std::make_unique<InterpolatedBlock<Dim>>(interpolation_, box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    noise_.evaluate(points, samples);
  }
  double variance() const override { return noise_.variance(); }
  Vec<Dim> gradient_variance() const override { return noise_.gradient_variance(); }
  double power_spectrum(const Vec<Dim>& frequency) const override { return noise_.power_spectrum(frequency); }
  double excess_kurtosis() const override { return noise_.excess_kurtosis(); }
  typename Noise<Dim>::Band band() const override { return noise_.band(); }
  WaveMixture<Dim> waves() const override { return noise_.waves(); }
  double covariance(const Vec<Dim>& displacement) const override { return noise_.covariance(displacement); }

 private:
  std::shared_ptr<const Interpolation<Dim>> interpolation_;
  const Noise<Dim>& noise_;
};

}  // namespace

template <int Dim>
std::shared_ptr<const Noise<Dim>> interpolate(std::shared_ptr<const Noise<Dim>> noise,
                                              const LatticeFrame<Dim>& frame, double error,
                                              Quantity quantity) {
  const InterpolationPlanner<Dim> planner(*noise, frame);
  const auto of_values = planner.plan(error, Quantity::values);
  const auto of_gradient = planner.plan(error, Quantity::gradient);
  const auto follow = [&](const std::shared_ptr<const Noise<Dim>>& part,
                          std::size_t i) -> std::shared_ptr<const Noise<Dim>> {
    if (of_gradient[i].direct() && (of_values[i].direct() || quantity == Quantity::gradient)) return part;
    const auto interpolation = std::make_shared<Interpolation<Dim>>();
    interpolation->noise = part;
    interpolation->frame = frame;
    if (!of_values[i].direct()) {
      interpolation->values.emplace(part, frame, planner.weights(i, of_values[i], Quantity::values));
    }
    if (!of_gradient[i].direct()) {
      interpolation->gradient.emplace(part, frame, planner.weights(i, of_gradient[i], Quantity::gradient));
    }
    return std::make_shared<InterpolatedNoise<Dim>>(interpolation);
  };
  const auto parts = noise->parts();
  if (parts.empty()) return follow(noise, 0);
  bool any = false;
  std::vector<typename FractalNoise<Dim>::Octave> octaves;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    octaves.push_back({follow(parts[i].noise, i), parts[i].amplitude});
    any = any || octaves.back().noise != parts[i].noise;
  }
  return any ? std::make_shared<FractalNoise<Dim>>(std::move(octaves)) : noise;
}

template std::shared_ptr<const Noise<2>> interpolate<2>(std::shared_ptr<const Noise<2>>,
                                                        const LatticeFrame<2>&, double, Quantity);
template std::shared_ptr<const Noise<3>> interpolate<3>(std::shared_ptr<const Noise<3>>,
                                                        const LatticeFrame<3>&, double, Quantity);

}  // namespace solidnoise
