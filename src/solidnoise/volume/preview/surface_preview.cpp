#include <algorithm>
#include <optional>
#include <stdexcept>

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/RayIntersector.h>

#include "solidnoise/volume/preview/preview.h"
#include "solidnoise/volume/preview/preview_view.h"

namespace solidnoise {
namespace {

using openvdb::Vec3d;
using SurfaceIntersector = openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid>;
using Ray = SurfaceIntersector::RayType;

const Vec3d kSun(1.05, 0.98, 0.86);
const Vec3d kSkyLight(0.30, 0.37, 0.48);
const Vec3d kGroundLight(0.13, 0.115, 0.10);  // from below
const Vec3d kAlbedo(0.52, 0.49, 0.45);

class SurfacePainter {
 public:
  SurfacePainter(const openvdb::FloatGrid& grid, const PreviewOptions& options)
      : grid_(grid),
        options_(options),
        view_(three_quarter_view(options.up)),
        vertical_(vertical(options.up)),
        to_sun_(direction_to_sun(options.up)) {
    if (grid.activeVoxelCount() == 0) return;
    intersector_.emplace(grid);
    camera_ = frame_grid(framing_grid(grid, options), view_, options.width, options.height);
  }

  void paint_row(int y, Image& image) const {
    constexpr int kAcross = 2;                                     // rays
    std::optional<SurfaceIntersector> intersector = intersector_;  // it has a state
    for (int x = 0; x < options_.width; ++x) {
      Vec3d sum(0.0);
      for (int i = 0; i < kAcross * kAcross; ++i) {
        sum += light_at(x + (i % kAcross + 0.5) / kAcross, y + (i / kAcross + 0.5) / kAcross, intersector);
      }
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y, channel) = encode_light(sum[channel] / (kAcross * kAcross));
      }
    }
  }

 private:
  // In pixels from the picture's left and top.
  Vec3d light_at(double x, double y, std::optional<SurfaceIntersector>& intersector) const {
    const Vec3d background = sky(1.0 - y / options_.height);
    if (!intersector) return background;
    const Vec3d direction = direction_at(camera_, view_, x / options_.width, y / options_.height);
    Vec3d point;
    if (!intersector->intersectsWS(Ray(camera_.eye, direction), point)) return background;
    const Vec3d normal = normal_at(point);

    // A ray to the sun begins off the surface, which is known to a part of a voxel.
    const double lit = std::max(0.0, normal.dot(to_sun_));
    const Vec3d start = point + 1.5 * grid_.voxelSize().x() * normal;
    const bool in_shadow = lit > 0.0 && intersector->intersectsWS(Ray(start, to_sun_));
    const double above = 0.5 + 0.5 * normal.dot(vertical_);
    const Vec3d light = (in_shadow ? 0.0 : lit) * kSun + above * kSkyLight + (1.0 - above) * kGroundLight;
    return kAlbedo * light;
  }

  // By differences over two voxels of what is interpolated between them: the slope inside of one voxel, which
  // the intersector has, jumps at its faces, and shows as hatching.
  Vec3d normal_at(const Vec3d& point) const {
    const auto distance = grid_.getConstUnsafeAccessor();
    const Vec3d index = grid_.worldToIndex(point);
    Vec3d slope;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d step(0.0);
      step[axis] = 1.0;
      slope[axis] = openvdb::tools::BoxSampler::sample(distance, index + step) -
                    openvdb::tools::BoxSampler::sample(distance, index - step);
    }
    return slope.lengthSqr() > 0.0 ? slope.unit() : vertical_;
  }

  const openvdb::FloatGrid& grid_;
  const PreviewOptions& options_;
  const View view_;
  const Vec3d vertical_;
  const Vec3d to_sun_;
  std::optional<SurfaceIntersector> intersector_;
  Camera camera_;
};

}  // namespace

Image render_surface(const openvdb::FloatGrid& level_set, const PreviewOptions& options, Progress* progress) {
  require_picture(level_set, options);
  if (level_set.getGridClass() != openvdb::GRID_LEVEL_SET) {
    throw std::invalid_argument("the grid's class is not level set");
  }
  return paint(SurfacePainter(level_set, options), options, progress);
}

}  // namespace solidnoise
