#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/section_spectrum.h"

namespace solidnoise {
namespace {

// Samples of places on a plane.
void evaluate_on_plane(const Noise<3>& noise, const Plane& plane, std::span<const Vec<2>> places,
                       const Samples<2>& samples) {
  require_room(samples, places.size());
  std::vector<Vec<3>> positions;
  positions.reserve(places.size());
  for (const Vec<2>& place : places) {
    positions.push_back(plane.origin + place.x * plane.right + place.y * plane.up);
  }
  std::array<std::vector<float>, 3> gradient;
  Samples<3> in_space{samples.values, {}, samples.gradient_alone};
  for (std::size_t axis = 0; samples.wants_gradient() && axis < 3; ++axis) {
    gradient[axis].resize(places.size());
    in_space.gradient[axis] = gradient[axis];
  }
  noise.evaluate({positions}, in_space);
  for (std::size_t k = 0; samples.wants_gradient() && k < places.size(); ++k) {
    const Vec<3> slope(gradient[0][k], gradient[1][k], gradient[2][k]);
    samples.gradient[0][k] = static_cast<float>(glm::dot(slope, plane.right));
    samples.gradient[1][k] = static_cast<float>(glm::dot(slope, plane.up));
  }
}

class PlaneBlock final : public FieldBlock<2> {
 public:
  PlaneBlock(std::shared_ptr<const Noise<3>> noise, const Plane& plane)
      : noise_(std::move(noise)), plane_(plane) {}

  void evaluate(const Lattice<2>& lattice, const Samples<2>& samples) const override {
    std::vector<Vec<2>> places;
    places.reserve(lattice.size());
    for (int x = 0; x < lattice.count.x; ++x) {
      for (int y = 0; y < lattice.count.y; ++y) {
        places.emplace_back(lattice.coordinate(0, x), lattice.coordinate(1, y));
      }
    }
    evaluate_on_plane(*noise_, plane_, places, samples);
  }

 private:
  std::shared_ptr<const Noise<3>> noise_;
  Plane plane_;
};

// Where a plane along two axes of space, in their order, lies among the three.
struct PlaneAxes {
  int right = 0;
  int up = 1;
  int across = 2;

  static std::optional<PlaneAxes> of(const Plane& plane) {
    for (const PlaneAxes axes : {PlaneAxes{0, 1, 2}, PlaneAxes{0, 2, 1}, PlaneAxes{1, 2, 0}}) {
      if (plane.right[axes.right] == 1.0 && plane.up[axes.up] == 1.0) return axes;
    }
    return std::nullopt;
  }

  // A vector of the plane in space, with a third component.
  template <typename Vector3, typename Vector2, typename Component>
  Vector3 in_space(const Vector2& vector, Component third) const {
    Vector3 result;
    result[right] = vector[0];
    result[up] = vector[1];
    result[across] = third;
    return result;
  }
};

// Lattices of such a plane are lattices of space.
class AlignedPlaneBlock final : public FieldBlock<2> {
 public:
  AlignedPlaneBlock(const Noise<3>& noise, const Plane& plane, const PlaneAxes& axes, const Box<2>& box)
      : origin_(plane.origin),
        axes_(axes),
        block_(noise.block({origin_ + axes.in_space<Vec<3>>(box.lower, 0.0),
                            origin_ + axes.in_space<Vec<3>>(box.upper, 0.0)})) {}

  void evaluate(const Lattice<2>& lattice, const Samples<2>& samples) const override {
    Lattice<3> in_space;
    in_space.origin = origin_ + axes_.in_space<Vec<3>>(lattice.origin, 0.0);
    in_space.step = axes_.in_space<Vec<3>>(lattice.step, 1.0);
    in_space.first = axes_.in_space<Index<3>>(lattice.first, 0);
    in_space.count = axes_.in_space<glm::ivec3>(lattice.count, 1);
    std::vector<float> across;
    Samples<3> all{samples.values, {}, samples.gradient_alone};
    if (samples.wants_gradient()) {
      across.resize(samples.values.size());
      all.gradient = axes_.in_space<std::array<std::span<float>, 3>>(samples.gradient, std::span(across));
    }
    block_->evaluate(in_space, all);
  }

 private:
  Vec<3> origin_;
  PlaneAxes axes_;
  std::unique_ptr<FieldBlock<3>> block_;
};

// The frequencies of waves that signs of coordinates stand for, up to the sign of all.
std::vector<Vec<3>> mirror_images(const Vec<3>& frequency) {
  std::vector<Vec<3>> images;
  for (const double y : {1.0, -1.0}) {
    for (const double z : {1.0, -1.0}) images.push_back(frequency * Vec<3>(1.0, y, z));
  }
  return images;
}

class PlaneNoise final : public Noise<2> {
 public:
  PlaneNoise(std::shared_ptr<const Noise<3>> noise, const Plane& plane)
      : noise_(std::move(noise)), plane_(plane) {}

  using Noise<2>::evaluate;

  std::unique_ptr<FieldBlock<2>> block(const Box<2>& box) const override {
    if (const auto axes = PlaneAxes::of(plane_)) {
      return std::make_unique<AlignedPlaneBlock>(*noise_, plane_, *axes, box);
    }
    return std::make_unique<PlaneBlock>(noise_, plane_);
  }

  void evaluate(const Points<2>& points, const Samples<2>& samples) const override {
    evaluate_on_plane(*noise_, plane_, points.positions, samples);
  }

  double variance() const override { return noise_->variance(); }

  // Of noises that are not stationary, as if the derivatives along the axes were uncorrelated.
  Vec<2> gradient_variance() const override {
    const Vec<3> in_space = noise_->gradient_variance();
    const WaveMixture<2> mixture = waves();
    if (mixture.waves.empty()) {
      return {glm::dot(plane_.right * plane_.right, in_space), glm::dot(plane_.up * plane_.up, in_space)};
    }
    Vec<2> sum(0.0);
    for (const auto& wave : mixture.waves) {
      for (int axis = 0; axis < 2; ++axis) sum[axis] += wave.variance * mixture.slope_variance(wave, axis);
    }
    return sum;
  }

  double power_spectrum(const Vec<2>& frequency) const override {
    const Vec<3> across = glm::cross(plane_.right, plane_.up);
    const Vec<3> in_plane = frequency.x * plane_.right + frequency.y * plane_.up;
    return section_spectrum(*noise_, [&](double f) { return in_plane + f * across; });
  }

  double excess_kurtosis() const override { return noise_->excess_kurtosis(); }

  // A plane has all lower frequencies.
  Band band() const override { return {0.0, noise_->band().upper}; }

  std::vector<Part> parts() const override {
    std::vector<Part> parts;
    for (const auto& part : noise_->parts()) {
      parts.push_back({std::make_shared<PlaneNoise>(part.noise, plane_), part.amplitude});
    }
    return parts;
  }

  double covariance(const Vec<2>& displacement) const override {
    return noise_->covariance(displacement.x * plane_.right + displacement.y * plane_.up);
  }

  // At displacements in the plane, waves differ by their frequencies in it alone. They are mirror images of
  // each other along its axes only if these are those of space.
  WaveMixture<2> waves() const override {
    const WaveMixture<3> all = noise_->waves();
    const bool mirror = all.symmetry == WaveMixture<3>::Symmetry::mirror;
    const bool aligned = is_axis(plane_.right) && is_axis(plane_.up);
    WaveMixture<2> result;
    if (mirror && aligned) result.symmetry = WaveMixture<2>::Symmetry::mirror;
    const auto add = [&](const auto& from, auto& to) {
      for (const auto& wave : from) {
        const auto images = mirror && !aligned ? mirror_images(wave.frequency) : std::vector{wave.frequency};
        for (const Vec<3>& image : images) {
          to.push_back({wave.variance / static_cast<double>(images.size()),
                        {glm::dot(image, plane_.right), glm::dot(image, plane_.up)}});
        }
      }
    };
    add(all.waves, result.waves);
    add(all.truncation_waves, result.truncation_waves);
    result.a = all.a;
    result.truncation = all.truncation;
    result.impulses = all.impulses;
    result.radius = all.radius;
    result.work = all.work;
    return result;
  }

 private:
  static bool is_axis(const Vec<3>& direction) {
    return std::abs(direction.x) == 1.0 || std::abs(direction.y) == 1.0 || std::abs(direction.z) == 1.0;
  }

  std::shared_ptr<const Noise<3>> noise_;
  Plane plane_;
};

}  // namespace

std::unique_ptr<Noise<2>> on_plane(std::shared_ptr<const Noise<3>> noise, const Plane& plane) {
  return std::make_unique<PlaneNoise>(std::move(noise), plane);
}

}  // namespace solidnoise
