#include "solidnoise/field/curl_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// The potentials and their derivatives at some samples, or the gradients alone, as evaluate(c, samples)
// writes those of potential c.
class Potentials {
 public:
  template <typename Evaluate>
  Potentials(std::size_t size, bool gradient_alone, const Evaluate& evaluate)
      : size_(size), memory_(3 * 4 * size_) {
    for (std::size_t c = 0; c < 3; ++c) {
      evaluate(c, Samples<3>{channel(c, 0), {channel(c, 1), channel(c, 2), channel(c, 3)}, gradient_alone});
    }
  }

  std::size_t size() const { return size_; }
  float value(std::size_t potential, std::size_t sample) const { return at(potential, 0, sample); }
  float derivative(std::size_t potential, std::size_t axis, std::size_t sample) const {
    return at(potential, 1 + axis, sample);
  }

 private:
  std::span<float> channel(std::size_t potential, std::size_t part) {
    return std::span(memory_).subspan((4 * potential + part) * size_, size_);
  }
  float at(std::size_t potential, std::size_t part, std::size_t sample) const {
    return memory_[(4 * potential + part) * size_ + sample];
  }

  std::size_t size_;
  std::vector<float> memory_;
};

// The ramp and its derivative.
struct BoundaryRamp {
  double value = 0.0;
  double slope = 0.0;

  explicit BoundaryRamp(double r) {
    const double s = std::clamp(r, -1.0, 1.0);
    const double s2 = s * s;
    value = 0.125 * s * (15.0 - 10.0 * s2 + 3.0 * s2 * s2);
    slope = 1.875 * (1.0 - s2) * (1.0 - s2);
  }
};

class CurlField final : public Field<3> {
 public:
  CurlField(const CurlOptions& options, double scale)
      : options_(options), scale_(static_cast<float>(scale)) {}

  int channels() const override { return 3; }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(*this, box);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(*this, samples, points.size());
    const Potentials potentials(points.size(), !options_.boundary, [&](std::size_t c, const Samples<3>& jet) {
      options_.potentials[c]->evaluate(points, jet);
    });
    take_curl(potentials, samples.values);
    if (options_.boundary) bend(points.positions, potentials, samples.values);
    add_drift(samples.values);
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    Block(const CurlField& field, const Box<3>& box) : field_(field) {
      for (std::size_t c = 0; c < 3; ++c) blocks_[c] = field.options_.potentials[c]->block(box);
    }

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      require_room(field_, samples, lattice.size());
      const Potentials potentials(
          lattice.size(), !field_.options_.boundary,
          [&](std::size_t c, const Samples<3>& jet) { blocks_[c]->evaluate(lattice, jet); });
      field_.take_curl(potentials, samples.values);
      if (field_.options_.boundary) field_.bend(positions_of({&lattice, 1}), potentials, samples.values);
      field_.add_drift(samples.values);
    }

   private:
    const CurlField& field_;
    std::array<std::unique_ptr<FieldBlock<3>>, 3> blocks_;
  };

  void take_curl(const Potentials& potentials, std::span<float> values) const {
    const std::size_t size = potentials.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3;
      const std::size_t last = (axis + 2) % 3;
      for (std::size_t i = 0; i < size; ++i) {
        values[axis * size + i] =
            scale_ * (potentials.derivative(last, next, i) - potentials.derivative(next, last, i));
      }
    }
  }

  void add_drift(std::span<float> values) const {
    const std::size_t size = values.size() / 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto drift = static_cast<float>(options_.drift[static_cast<int>(axis)]);
      if (drift == 0.0f) continue;
      for (float& component : values.subspan(axis * size, size)) component += drift;
    }
  }

  // Replaces the velocities near the boundary.
  void bend(std::span<const Vec<3>> positions, const Potentials& potentials, std::span<float> values) const {
    const std::size_t size = positions.size();
    std::vector<SmoothDistance::Jet> jets(size);
    options_.boundary->evaluate(positions, jets);
    for (std::size_t i = 0; i < size; ++i) {
      if (jets[i].distance >= options_.boundary->reach()) continue;
      Vec<3> velocity;
      for (int axis = 0; axis < 3; ++axis) velocity[axis] = values[static_cast<std::size_t>(axis) * size + i];
      velocity = bent(velocity, jets[i], potentials, i);
      for (int axis = 0; axis < 3; ++axis) {
        values[static_cast<std::size_t>(axis) * size + i] = static_cast<float>(velocity[axis]);
      }
    }
  }

  Vec<3> bent(const Vec<3>& velocity, const SmoothDistance::Jet& jet, const Potentials& potentials,
              std::size_t sample) const {
    const double reach = options_.boundary->reach();
    const BoundaryRamp ramp(jet.distance / reach);
    Vec<3> psi;
    Vec<3> normal_slope(0.0);  // the gradient of g.psi
    for (std::size_t c = 0; c < 3; ++c) {
      const int axis = static_cast<int>(c);
      psi[axis] = potentials.value(c, sample);
      const Vec<3> gradient(potentials.derivative(c, 0, sample), potentials.derivative(c, 1, sample),
                            potentials.derivative(c, 2, sample));
      normal_slope += jet.gradient[axis] * gradient + psi[axis] * jet.hessian[c];
    }
    const Vec<3> along = ramp.slope / reach * glm::cross(jet.gradient, psi) +
                         (1.0 - std::abs(ramp.value)) * glm::cross(normal_slope, jet.gradient);
    return ramp.value * velocity + static_cast<double>(scale_) * along;
  }

  CurlOptions options_;
  float scale_;
};

}  // namespace

FieldPtr make_curl_field(const CurlOptions& options) {
  require_positive("speed", options.speed, "world units per second");
  double mean_square = 0.0;
  for (int c = 0; c < 3; ++c) {
    const auto& potential = options.potentials[static_cast<std::size_t>(c)];
    if (potential == nullptr) throw std::invalid_argument("a curl needs three potentials");
    const Vec<3> variance = potential->gradient_variance();
    mean_square += variance[(c + 1) % 3] + variance[(c + 2) % 3];
  }
  return std::make_shared<CurlField>(options,
                                     options.speed / std::sqrt(options.mean_square.value_or(mean_square)));
}

double curl_mean_square(const Noise<3>& potential) {
  const Vec<3> variance = potential.gradient_variance();
  return 2.0 * (variance.x + variance.y + variance.z);
}

}  // namespace solidnoise
