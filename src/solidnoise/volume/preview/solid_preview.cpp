#include "solidnoise/volume/preview/solid_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/RayIntersector.h>

#include "solidnoise/volume/preview/preview_view.h"

namespace solidnoise {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3d;
using Intersector = openvdb::tools::VolumeRayIntersector<FloatGrid>;
using Ray = Intersector::RayType;
using Sampler = openvdb::tools::BoxSampler;

const Vec3d kKeyLight(0.92, 0.87, 0.78);
const Vec3d kFillLight(0.34, 0.37, 0.42);
const Vec3d kBounceLight(0.17, 0.16, 0.15);  // from below

// Before which it stands; `height` from 0 at the bottom of the picture.
Vec3d studio(double height) {
  return Vec3d(0.30, 0.31, 0.33) * (1.0 - 0.75 * height);
}

// Where a body is, in index space, and which way its surface looks. For one thread.
class Body {
 public:
  Body(const FloatGrid& values, const FloatGrid* body)
      : grid_(body != nullptr ? *body : values), accessor_(grid_.getConstAccessor()) {
    if (body == nullptr) return;
    float peak = 0.0f;
    for (auto value = body->cbeginValueOn(); value; ++value) peak = std::max(peak, *value);
    scale_ = 1.0f / std::max(peak, std::numeric_limits<float>::min());
  }

  // About 0 to 1, a half at the surface.
  double inside(const Vec3d& place) const {
    if (scale_ > 0.0f) return scale_ * Sampler::sample(accessor_, place);
    const openvdb::Coord low = openvdb::Coord::floor(place);
    const Vec3d part = place - low.asVec3d();
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      openvdb::Coord at = low;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = (corner >> axis & 1) != 0;
        at[axis] += upper;
        weight *= upper ? part[axis] : 1.0 - part[axis];
      }
      if (accessor_.isValueOn(at)) sum += weight;
    }
    return sum;
  }

  // Over so many voxels that their steps are not seen.
  Vec3d normal(const Vec3d& place) const {
    constexpr double kReach = 1.7;
    Vec3d sum(0.0);
    for (int i = 0; i < 27; ++i) {
      const Vec3d off(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      sum -= off * std::min(1.0, inside(place + kReach * off));
    }
    return sum.lengthSqr() > 0.0 ? sum.unit() : Vec3d(0.0, 1.0, 0.0);
  }

 private:
  const FloatGrid& grid_;
  FloatGrid::ConstAccessor accessor_;
  float scale_ = 0.0f;  // 0: the active voxels
};

struct Hit {
  Vec3d place;   // in index space
  Vec3d normal;  // of length 1
};

class SolidPainter {
 public:
  SolidPainter(const FloatGrid& values, const FloatGrid* body, const SolidLook& look,
               const PreviewOptions& options)
      : values_(values),
        body_(body != nullptr ? *body : values),
        look_(look),
        options_(options),
        view_(three_quarter_view(options.up)),
        vertical_(vertical(options.up)),
        to_sun_((-0.35 * view_.right + 0.75 * vertical_ + 0.55 * view_.back).unit()),
        shape_(values, body) {
    if (body_.activeVoxelCount() == 0) return;
    intersector_.emplace(body_, 1);
    const FloatGrid& framing = framing_grid(body_, options);
    camera_ = frame_grid(framing, view_, options.width, options.height);
    if (!look.is_cut) return;
    const Vec3d low =
        body_.worldToIndex(framing.indexToWorld(framing.evalActiveVoxelBoundingBox().min().asVec3d()));
    const Vec3d high =
        body_.worldToIndex(framing.indexToWorld(framing.evalActiveVoxelBoundingBox().max().asVec3d()));
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = 0.5 * (low[axis] + high[axis]);
      const bool upper = view_.back[axis] > 0.0;
      cut_[0][axis] = upper ? middle : low[axis] - 2.0;
      cut_[1][axis] = upper ? high[axis] + 2.0 : middle;
    }
  }

  void paint_row(int y, Image& image) const {
    constexpr int kAcross = 2;  // rays
    std::optional<Intersector> intersector;
    if (intersector_) intersector.emplace(*intersector_);  // it has a state
    const Body shape = shape_;
    const auto values = values_.getConstAccessor();
    for (int x = 0; x < options_.width; ++x) {
      Vec3d sum(0.0);
      for (int i = 0; i < kAcross * kAcross; ++i) {
        const double u = (x + (i % kAcross + 0.5) / kAcross) / options_.width;
        const double v = (y + (i / kAcross + 0.5) / kAcross) / options_.height;
        const Vec3d direction = direction_at(camera_, view_, u, v);
        const auto hit = intersector ? first_hit(direction, *intersector, shape) : std::nullopt;
        sum += hit ? light_at(*hit, direction, values) : studio(1.0 - v);
      }
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y, channel) = encode_light(sum[channel] / (kAcross * kAcross));
      }
    }
  }

 private:
  // When a ray is in what is cut off, and the axis of the face through which it leaves that.
  struct Gap {
    double first = std::numeric_limits<double>::infinity();
    double last = -std::numeric_limits<double>::infinity();
    int axis = 0;
  };

  Gap gap_of(const Vec3d& eye, const Vec3d& direction) const {
    Gap gap{0.0, std::numeric_limits<double>::infinity(), 0};
    if (!look_.is_cut) return {};
    for (int axis = 0; axis < 3; ++axis) {
      double near = (cut_[0][axis] - eye[axis]) / direction[axis];
      double far = (cut_[1][axis] - eye[axis]) / direction[axis];
      if (near > far) std::swap(near, far);
      gap.first = std::max(gap.first, near);
      if (far < gap.last) gap.last = far, gap.axis = axis;
    }
    return gap.first < gap.last ? gap : Gap{};
  }

  std::optional<Hit> first_hit(const Vec3d& direction, Intersector& intersector, const Body& shape) const {
    constexpr double kStep = 0.5;  // voxels
    const Vec3d eye = body_.worldToIndex(camera_.eye);
    const Ray ray(eye, direction);  // a unit of it is a voxel, for they are cubes
    if (!intersector.setIndexRay(ray)) return std::nullopt;
    const Gap gap = gap_of(eye, direction);
    double first = 0.0;
    double last = 0.0;
    while (intersector.march(first, last)) {
      for (double t = first; t < last + kStep; t += kStep) {
        if (t >= gap.first && t < gap.last) {
          if (gap.last > last) break;
          t = gap.last;
          if (shape.inside(ray(t)) < 0.5) continue;
          Vec3d normal(0.0);
          normal[gap.axis] = direction[gap.axis] > 0.0 ? -1.0 : 1.0;
          return Hit{ray(t), normal};
        }
        if (shape.inside(ray(t)) < 0.5) continue;
        double outside = t - kStep;
        for (int i = 0; i < 6; ++i) {
          const double middle = 0.5 * (outside + t);
          (shape.inside(ray(middle)) < 0.5 ? outside : t) = middle;
        }
        return Hit{ray(t), shape.normal(ray(t))};
      }
    }
    return std::nullopt;
  }

  Vec3d light_at(const Hit& hit, const Vec3d& direction, const FloatGrid::ConstAccessor& values) const {
    // Under the surface, where all voxels that are interpolated belong to the body.
    const float value = Sampler::sample(values, hit.place - 1.2 * hit.normal);
    const Color colour = look_.ramp.linear((value - look_.least) / (look_.most - look_.least));
    const double above = 0.5 + 0.5 * hit.normal.dot(vertical_);
    const Vec3d light = std::max(0.0, hit.normal.dot(to_sun_)) * kKeyLight + above * kFillLight +
                        (1.0 - above) * kBounceLight;
    Vec3d seen = light * Vec3d(colour.x, colour.y, colour.z);
    if (look_.is_polished) {
      constexpr double kSharpness = 60.0;
      const Vec3d half = (to_sun_ - direction).unit();
      seen += 0.25 * std::pow(std::max(0.0, hit.normal.dot(half)), kSharpness) * kKeyLight;
      seen += 0.10 * std::pow(1.0 + std::min(0.0, hit.normal.dot(direction)), 3) * kFillLight;
    }
    return seen;
  }

  const FloatGrid& values_;
  const FloatGrid& body_;
  const SolidLook& look_;
  const PreviewOptions& options_;
  const View view_;
  const Vec3d vertical_;
  const Vec3d to_sun_;
  const Body shape_;
  std::optional<Intersector> intersector_;
  Camera camera_;
  std::array<Vec3d, 2> cut_{};  // corners of what is cut off, in index space
};

}  // namespace

Image render_solid(const FloatGrid& values, FloatGrid::ConstPtr body, const SolidLook& look,
                   const PreviewOptions& options, Progress* progress) {
  require_picture(values, options);
  return paint(SolidPainter(values, body.get(), look, options), options, progress);
}

}  // namespace solidnoise
