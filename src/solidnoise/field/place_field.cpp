#include "solidnoise/field/place_field.h"

#include <cmath>
#include <cstddef>
#include <memory>

#include "solidnoise/field/pointwise_field.h"

namespace solidnoise {
namespace {

class PlaceField final : public PointwiseField {
 public:
  PlaceField(const Box<3>& box, int vertical, Layer::Place place)
      : box_(box), vertical_(vertical), place_(place) {}

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples.values[i] =
          static_cast<float>(at((points.positions[i] - box_.lower) / (box_.upper - box_.lower)));
    }
  }

 private:
  // `p` is 0 to 1 in the box.
  double at(const Vec<3>& p) const {
    const Vec<3> q = 2.0 * p - 1.0;
    switch (place_) {
      case Layer::Place::x:
        return p.x;
      case Layer::Place::y:
        return p.y;
      case Layer::Place::z:
        return p.z;
      case Layer::Place::height:
        return p[vertical_];
      case Layer::Place::radius:
        return std::hypot(q.x, q[3 - vertical_]);
      case Layer::Place::distance:
      case Layer::Place::none:
        break;
    }
    return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  }

  Box<3> box_;
  int vertical_;
  Layer::Place place_;
};

}  // namespace

FieldPtr place_in(const Box<3>& box, UpAxis up, Layer::Place place) {
  return std::make_shared<PlaceField>(box, up == UpAxis::y ? 1 : 2, place);
}

}  // namespace solidnoise
