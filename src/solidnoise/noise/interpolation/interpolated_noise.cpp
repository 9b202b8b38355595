#include "solidnoise/noise/interpolation/interpolated_noise.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "solidnoise/noise/fractal_noise.h"
#include "solidnoise/noise/interpolation/interpolation_plan.h"
#include "solidnoise/noise/interpolation/point_interpolation.h"
#include "solidnoise/noise/same_statistics.h"

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
    const bool values = applies && interpolation_->values && !samples.gradient_alone;
    const bool gradient = applies && samples.wants_gradient() && interpolation_->gradient;
    if (!gradient && samples.wants_gradient()) {
      evaluate_directly(lattice, samples);
    } else if (samples.gradient_alone) {
      std::fill(samples.values.begin(), samples.values.end(), 0.0f);
    } else if (!values) {
      evaluate_directly(lattice, {samples.values});
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
class InterpolatedNoise final : public SameStatistics<Dim> {
 public:
  explicit InterpolatedNoise(std::shared_ptr<const Interpolation<Dim>> interpolation)
      : SameStatistics<Dim>(interpolation->noise), interpolation_(std::move(interpolation)) {}

  using Noise<Dim>::evaluate;
  std::unique_ptr<FieldBlock<Dim>> block(const Box<Dim>& box) const override {
    return std::make_unique<InterpolatedBlock<Dim>>(interpolation_, box);
  }
  void evaluate(const Points<Dim>& points, const Samples<Dim>& samples) const override {
    this->noise().evaluate(points, samples);
  }

 private:
  std::shared_ptr<const Interpolation<Dim>> interpolation_;
};

// A noise at points; gradients are summed.
class NoiseAtPoints final : public SameStatistics<3> {
 public:
  NoiseAtPoints(const std::shared_ptr<const Noise<3>>& noise, const LatticeFrame<3>& frame,
                const PointPlan& plan)
      : SameStatistics<3>(noise), interpolation_(noise, frame, plan) {}

  using Noise<3>::evaluate;
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override { return noise().block(box); }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(samples, points.size());
    if (samples.wants_gradient()) noise().evaluate(points, samples);
    if (!samples.gradient_alone) interpolation_.evaluate(points.positions, samples.values);
  }

 private:
  PointInterpolation interpolation_;
};

// The noise with something in the place of each of its parts, or of itself where it has none, by number; the
// noise itself where that is what they are.
template <int Dim, typename Follow>
std::shared_ptr<const Noise<Dim>> replace_parts(const std::shared_ptr<const Noise<Dim>>& noise,
                                                const Follow& follow) {
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
  return replace_parts<Dim>(noise, follow);
}

template std::shared_ptr<const Noise<2>> interpolate<2>(std::shared_ptr<const Noise<2>>,
                                                        const LatticeFrame<2>&, double, Quantity);
template std::shared_ptr<const Noise<3>> interpolate<3>(std::shared_ptr<const Noise<3>>,
                                                        const LatticeFrame<3>&, double, Quantity);

std::shared_ptr<const Noise<3>> interpolate_at_points(std::shared_ptr<const Noise<3>> noise,
                                                      const LatticeFrame<3>& frame, double error,
                                                      const PointSpread& spread) {
  using NoisePtr = std::shared_ptr<const Noise<3>>;
  const std::vector<PointPlan> plans = plan_points(*noise, frame, error, spread);
  return replace_parts<3>(noise, [&](const NoisePtr& part, std::size_t i) -> NoisePtr {
    if (plans[i].direct()) return part;
    return std::make_shared<NoiseAtPoints>(part, frame, plans[i]);
  });
}

}  // namespace solidnoise
