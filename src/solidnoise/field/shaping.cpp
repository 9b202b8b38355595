#include "solidnoise/field/shaping.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

#include "solidnoise/core/numerics.h"
#include "solidnoise/field/field_tables.h"
#include "solidnoise/field/pointwise_field.h"

namespace solidnoise {

void RawShaping::validate() const {}

void RemapShaping::validate() const {
  require_fields(*this);
}

void VeinShaping::validate() const {
  require_fields(*this);
  if (direction == Vec<3>(0.0)) {
    throw std::invalid_argument("direction is 0 0 0; it must have a length");
  }
}

void CloudShaping::validate() const {
  require_fields(*this);
}

namespace {

constexpr float kMostSigmas = 6.0f;

struct RangeMap {
  static constexpr float kSigmasToTheEnd = 3.0f;

  float centre;
  float half_width;

  float operator()(float v) const {
    return centre + half_width * std::clamp(v / kSigmasToTheEnd, -1.0f, 1.0f);
  }
  float slope(float v) const { return std::abs(v) < kSigmasToTheEnd ? half_width / kSigmasToTheEnd : 0.0f; }
};

// Of a range other than raw.
RangeMap range_map(RawShaping::Range range) {
  return range == RawShaping::Range::unit ? RangeMap{0.5f, 0.5f} : RangeMap{0.0f, 1.0f};
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

  // The square of the distance, 1 at the box's side.
  double along(int axis, double coordinate) const {
    const double distance = (coordinate - centre[axis]) / radii[axis];
    return distance * distance;
  }

  float operator()(float n, double distance_squared) const {
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
      nearest_squared += along(axis, std::clamp(centre[axis], box.lower[axis], box.upper[axis]));
    }
    if (shaping.edge > 0.0 && nearest_squared > 1.0) return true;
    const double highest = shaping.fold == RemapShaping::Fold::ridged ? 0.0 : kMostSigmas;
    return shaping.floor == 0.0 && shaping.threshold + shaping.edge * nearest_squared > highest;
  }
};

struct VeinMap {
  VeinShaping shaping;
  Vec<3> wave;  // spacings per world unit

  double along(int axis, double coordinate) const { return wave[axis] * coordinate; }

  float operator()(float n, double layer) const {
    const double phase = layer + shaping.turbulence * n;
    // Whole turns are taken off in double precision, so that veins far from the origin are as smooth as here.
    const float level = 0.5f + 0.5f * std::cos(static_cast<float>(2.0 * kPi * (phase - std::floor(phase))));
    const float floor = static_cast<float>(shaping.floor);
    return floor + (1.0f - floor) * std::pow(level, static_cast<float>(shaping.sharpness));
  }

  bool empty(const Box<3>&) const { return false; }
};

template <typename Map>
FieldPtr place(FieldPtr source, Map map) {
  return std::make_shared<PlacedField<Map>>(std::move(source), std::move(map));
}

}  // namespace

void to_range(RawShaping::Range range, std::span<float> values) {
  if (range == RawShaping::Range::raw) return;
  const RangeMap map = range_map(range);
  for (float& v : values) v = map(v);
}

FieldPtr shape(FieldPtr source, const RawShaping& shaping) {
  if (shaping.range == RawShaping::Range::raw) return source;
  return map_field(std::move(source), range_map(shaping.range));
}

FieldPtr shape(FieldPtr source, const RemapShaping& shaping, const Box<3>& box) {
  return place(std::move(source),
               RemapMap{shaping, (box.lower + box.upper) * 0.5, (box.upper - box.lower) * 0.5});
}

FieldPtr shape(FieldPtr source, const VeinShaping& shaping) {
  return place(std::move(source), VeinMap{shaping, glm::normalize(shaping.direction) / shaping.spacing});
}

}  // namespace solidnoise
