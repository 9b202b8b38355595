#include "solidnoise/volume/field/curl_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

// The potentials and their derivatives at the samples of a lattice.
class Potentials {
 public:
  Potentials(const std::array<std::unique_ptr<NoiseBlock<3>>, 3>& blocks, const Lattice<3>& lattice)
      : size_(lattice.size()), memory_(3 * 4 * size_) {
    for (std::size_t c = 0; c < 3; ++c) {
      blocks[c]->evaluate(lattice, {channel(c, 0), {channel(c, 1), channel(c, 2), channel(c, 3)}});
    }
  }

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
struct Ramp {
  double value = 0.0;
  double slope = 0.0;

  explicit Ramp(double r) {
    const double s = std::clamp(r, -1.0, 1.0);
    const double s2 = s * s;
    value = 0.125 * s * (15.0 - 10.0 * s2 + 3.0 * s2 * s2);
    slope = 1.875 * (1.0 - s2) * (1.0 - s2);
  }
};

class CurlBlock final : public FieldBlock {
 public:
  CurlBlock(std::array<std::unique_ptr<NoiseBlock<3>>, 3> blocks, float scale, const DistanceSpline* boundary)
      : blocks_(std::move(blocks)), scale_(scale), boundary_(boundary) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    const Potentials potentials(blocks_, lattice);
    const std::size_t size = lattice.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3;
      const std::size_t last = (axis + 2) % 3;
      for (std::size_t i = 0; i < size; ++i) {
        values[axis * size + i] =
            scale_ * (potentials.derivative(last, next, i) - potentials.derivative(next, last, i));
      }
    }
    if (boundary_) bend(lattice, potentials, values);
  }

 private:
  // Replaces the velocities near the boundary.
  void bend(const Lattice<3>& lattice, const Potentials& potentials, std::span<float> values) const {
    const DistanceSpline::Sampler distance(*boundary_);
    const std::size_t size = lattice.size();
    std::size_t sample = 0;
    for (int i = 0; i < lattice.count.x; ++i) {
      for (int j = 0; j < lattice.count.y; ++j) {
        for (int k = 0; k < lattice.count.z; ++k, ++sample) {
          const auto jet =
              distance.at({lattice.coordinate(0, i), lattice.coordinate(1, j), lattice.coordinate(2, k)});
          if (jet.distance >= boundary_->reach()) continue;
          Vec<3> velocity;
          for (int axis = 0; axis < 3; ++axis) {
            velocity[axis] = values[static_cast<std::size_t>(axis) * size + sample];
          }
          velocity = bent(velocity, jet, potentials, sample);
          for (int axis = 0; axis < 3; ++axis) {
            values[static_cast<std::size_t>(axis) * size + sample] = static_cast<float>(velocity[axis]);
          }
        }
      }
    }
  }

  Vec<3> bent(const Vec<3>& velocity, const DistanceSpline::Jet& jet, const Potentials& potentials,
              std::size_t sample) const {
    const Ramp ramp(jet.distance / boundary_->reach());
    Vec<3> psi;
    Vec<3> normal_slope(0.0);  // the gradient of g.psi
    for (std::size_t c = 0; c < 3; ++c) {
      const int axis = static_cast<int>(c);
      psi[axis] = potentials.value(c, sample);
      const Vec<3> gradient(potentials.derivative(c, 0, sample), potentials.derivative(c, 1, sample),
                            potentials.derivative(c, 2, sample));
      normal_slope += jet.gradient[axis] * gradient + psi[axis] * jet.hessian[c];
    }
    const Vec<3> along = ramp.slope / boundary_->reach() * glm::cross(jet.gradient, psi) +
                         (1.0 - std::abs(ramp.value)) * glm::cross(normal_slope, jet.gradient);
    return ramp.value * velocity + static_cast<double>(scale_) * along;
  }

  std::array<std::unique_ptr<NoiseBlock<3>>, 3> blocks_;
  float scale_;
  const DistanceSpline* boundary_;  // the field's own, which outlives its blocks
};

class CurlField final : public Field {
 public:
  CurlField(const CurlOptions& options, double scale)
      : options_(options), scale_(static_cast<float>(scale)) {}

  int channels() const override { return 3; }
  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    std::array<std::unique_ptr<NoiseBlock<3>>, 3> blocks;
    for (std::size_t c = 0; c < 3; ++c) blocks[c] = options_.potentials[c]->block(box);
    return std::make_unique<CurlBlock>(std::move(blocks), scale_, options_.boundary.get());
  }

 private:
  CurlOptions options_;
  float scale_;
};

}  // namespace

std::unique_ptr<Field> make_curl_field(const CurlOptions& options) {
  require_positive("speed", options.speed, "world units per second");
  double mean_square = 0.0;
  for (int c = 0; c < 3; ++c) {
    const auto& potential = options.potentials[static_cast<std::size_t>(c)];
    if (potential == nullptr) throw std::invalid_argument("a curl needs three potentials");
    const Vec<3> variance = potential->gradient_variance();
    mean_square += variance[(c + 1) % 3] + variance[(c + 2) % 3];
  }
  return std::make_unique<CurlField>(options,
                                     options.speed / std::sqrt(options.mean_square.value_or(mean_square)));
}

double curl_mean_square(const Noise<3>& potential) {
  const Vec<3> variance = potential.gradient_variance();
  return 2.0 * (variance.x + variance.y + variance.z);
}

}  // namespace solidnoise
