#include "solidnoise/volume/field/shaped_noise_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

constexpr float kMostSigmas = 6.0f;

// Evaluates a field and then maps each value, given its place in the lattice.
template <typename Map>
class MappedBlock final : public FieldBlock {
 public:
  MappedBlock(std::unique_ptr<FieldBlock> source, const Map& map) : source_(std::move(source)), map_(map) {}

  void evaluate(const Lattice<3>& lattice, std::span<float> values) const override {
    source_->evaluate(lattice, values);
    map_(lattice, values);
  }

  void evaluate_all(std::span<const Lattice<3>> lattices, std::span<float> values) const override {
    source_->evaluate_all(lattices, values);
    for (const Lattice<3>& lattice : lattices) {
      map_(lattice, values.first(lattice.size()));
      values = values.subspan(lattice.size());
    }
  }

 private:
  std::unique_ptr<FieldBlock> source_;
  const Map& map_;  // the field's own, which outlives its blocks
};

template <typename Map>
class MappedField final : public Field {
 public:
  MappedField(std::shared_ptr<const Field> source, Map map)
      : source_(std::move(source)), map_(std::move(map)) {}

  std::unique_ptr<FieldBlock> block(const Box<3>& box) const override {
    return std::make_unique<MappedBlock<Map>>(source_->block(box), map_);
  }
  bool empty(const Box<3>& box) const override { return map_.empty(box); }

 private:
  std::shared_ptr<const Field> source_;
  Map map_;
};

struct RangeMap {
  RawShaping::Range range;

  void operator()(const Lattice<3>&, std::span<float> values) const { to_range(range, values); }
  bool empty(const Box<3>&) const { return false; }
};

float smoothstep(float t) {
  const float s = std::clamp(t, 0.0f, 1.0f);
  return s * s * (3.0f - 2.0f * s);
}

float folded(RemapShaping::Fold fold, float n) {
  switch (fold) {
    case RemapShaping::Fold::ridged:
      return -std::abs(n);
    case RemapShaping::Fold::billow:
      return std::abs(n);
    case RemapShaping::Fold::none:
      break;
  }
  return n;
}

struct RemapMap {
  RemapShaping shaping;
  Vec<3> centre;
  Vec<3> radii;

  void operator()(const Lattice<3>& lattice, std::span<float> values) const {
    std::array<std::vector<double>, 3> squares;  // of the distance along each axis, 1 at the box's side
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < lattice.count[axis]; ++i) {
        const double distance = (lattice.coordinate(axis, i) - centre[axis]) / radii[axis];
        squares[axis].push_back(distance * distance);
      }
    }
    float* value = values.data();
    for (const double x2 : squares[0]) {
      for (const double y2 : squares[1]) {
        for (const double z2 : squares[2]) {
          *value = density(*value, x2 + y2 + z2);
          ++value;
        }
      }
    }
  }

  float density(float n, double distance_squared) const {
    if (shaping.edge > 0.0 && distance_squared >= 1.0) return 0.0f;
    const double threshold = shaping.threshold + shaping.edge * distance_squared;
    const float level = folded(shaping.fold, std::clamp(n, -kMostSigmas, kMostSigmas));
    const float step = smoothstep(static_cast<float>((level - threshold) / shaping.softness));
    const float sharpened = shaping.power == 1.0 ? step : std::pow(step, static_cast<float>(shaping.power));
    const float floor = static_cast<float>(shaping.floor);
    return floor + (1.0f - floor) * sharpened;
  }

  bool empty(const Box<3>& box) const {
    double nearest_squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double nearest = std::clamp(centre[axis], box.lower[axis], box.upper[axis]);
      const double distance = (nearest - centre[axis]) / radii[axis];
      nearest_squared += distance * distance;
    }
    if (shaping.edge > 0.0 && nearest_squared > 1.0) return true;
    const double highest = shaping.fold == RemapShaping::Fold::ridged ? 0.0 : kMostSigmas;
    return shaping.floor == 0.0 && shaping.threshold + shaping.edge * nearest_squared > highest;
  }
};

struct VeinMap {
  VeinShaping shaping;
  Vec<3> wave;  // spacings per world unit

  void operator()(const Lattice<3>& lattice, std::span<float> values) const {
    float* value = values.data();
    for (int i = 0; i < lattice.count.x; ++i) {
      const double x = wave.x * lattice.coordinate(0, i);
      for (int j = 0; j < lattice.count.y; ++j) {
        const double y = wave.y * lattice.coordinate(1, j);
        for (int k = 0; k < lattice.count.z; ++k) {
          *value = density(x + y + wave.z * lattice.coordinate(2, k), *value);
          ++value;
        }
      }
    }
  }

  float density(double layer, float n) const {
    constexpr double kTau = 2.0 * std::numbers::pi;
    const double phase = layer + shaping.turbulence * n;
    // Whole turns are taken off in double precision, so that veins far from the origin are as smooth as here.
    const float level = 0.5f + 0.5f * std::cos(static_cast<float>(kTau * (phase - std::floor(phase))));
    const float floor = static_cast<float>(shaping.floor);
    return floor + (1.0f - floor) * std::pow(level, static_cast<float>(shaping.sharpness));
  }

  bool empty(const Box<3>&) const { return false; }
};

}  // namespace

void to_range(RawShaping::Range range, std::span<float> values) {
  if (range == RawShaping::Range::raw) return;
  constexpr float kSigmasToTheEnd = 3.0f;
  const float centre = range == RawShaping::Range::unit ? 0.5f : 0.0f;
  const float half_width = range == RawShaping::Range::unit ? 0.5f : 1.0f;
  for (float& v : values) v = centre + half_width * std::clamp(v / kSigmasToTheEnd, -1.0f, 1.0f);
}

std::unique_ptr<Field> make_field(std::shared_ptr<const Field> source, const RawShaping& shaping) {
  return std::make_unique<MappedField<RangeMap>>(std::move(source), RangeMap{shaping.range});
}

std::unique_ptr<Field> make_field(std::shared_ptr<const Field> source, const RemapShaping& shaping,
                                  const Box<3>& box) {
  const Vec<3> centre = (box.lower + box.upper) * 0.5;
  const Vec<3> radii = (box.upper - box.lower) * 0.5;
  return std::make_unique<MappedField<RemapMap>>(std::move(source), RemapMap{shaping, centre, radii});
}

std::unique_ptr<Field> make_field(std::shared_ptr<const Field> source, const VeinShaping& shaping) {
  const Vec<3> wave = glm::normalize(shaping.direction) / shaping.spacing;
  return std::make_unique<MappedField<VeinMap>>(std::move(source), VeinMap{shaping, wave});
}

std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const RawShaping& shaping) {
  return make_field(std::make_shared<NoiseField>(std::move(noise)), shaping);
}

std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const RemapShaping& shaping,
                                  const Box<3>& box) {
  return make_field(std::make_shared<NoiseField>(std::move(noise)), shaping, box);
}

std::unique_ptr<Field> make_field(std::shared_ptr<const Noise<3>> noise, const VeinShaping& shaping) {
  return make_field(std::make_shared<NoiseField>(std::move(noise)), shaping);
}

}  // namespace solidnoise
