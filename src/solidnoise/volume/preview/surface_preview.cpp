#include "solidnoise/volume/preview/surface_preview.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include <openvdb/tools/RayIntersector.h>
#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/preview/preview_view.h"

namespace solidnoise {
namespace {

using openvdb::Vec3d;
using Intersector = openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid>;
using Ray = Intersector::RayType;

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
        vertical_(options.up == UpAxis::y ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)),
        to_sun_((-0.85 * view_.right + 0.70 * vertical_ + 0.25 * view_.back).unit()) {
    if (grid.activeVoxelCount() == 0) return;
    intersector_.emplace(grid);
    camera_ = frame_grid(framing_grid(grid, options), view_, options.width, options.height);
  }

  void paint_row(int y, Image& image) const {
    constexpr int kAcross = 2;                              // rays
    std::optional<Intersector> intersector = intersector_;  // it has a state
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
  Vec3d light_at(double x, double y, std::optional<Intersector>& intersector) const {
    const Vec3d background = sky(1.0 - y / options_.height);
    if (!intersector) return background;
    const double across = (2.0 * x / options_.width - 1.0) * camera_.tan_x;
    const double upwards = (1.0 - 2.0 * y / options_.height) * camera_.tan_y;
    const Vec3d direction = (across * view_.right + upwards * view_.up - view_.back).unit();
    Vec3d point;
    Vec3d normal;
    if (!intersector->intersectsWS(Ray(camera_.eye, direction), point, normal)) return background;

    // A ray to the sun begins off the surface, which is known to a part of a voxel.
    const double lit = std::max(0.0, normal.dot(to_sun_));
    const Vec3d start = point + 1.5 * grid_.voxelSize().x() * normal;
    const bool in_shadow = lit > 0.0 && intersector->intersectsWS(Ray(start, to_sun_));
    const double above = 0.5 + 0.5 * normal.dot(vertical_);
    const Vec3d light = (in_shadow ? 0.0 : lit) * kSun + above * kSkyLight + (1.0 - above) * kGroundLight;
    return kAlbedo * light;
  }

  const openvdb::FloatGrid& grid_;
  const PreviewOptions& options_;
  const View view_;
  const Vec3d vertical_;
  const Vec3d to_sun_;
  std::optional<Intersector> intersector_;
  Camera camera_;
};

}  // namespace

Image render_surface(const openvdb::FloatGrid& level_set, const PreviewOptions& options, Progress* progress) {
  require_in_range("the preview's width", options.width, 16, 8192, "pixels");
  require_in_range("the preview's height", options.height, 16, 8192, "pixels");
  if (level_set.getGridClass() != openvdb::GRID_LEVEL_SET) {
    throw std::invalid_argument("the grid's class is not level set");
  }
  if (!level_set.hasUniformVoxels()) throw std::invalid_argument("a preview needs voxels that are cubes");
  const SurfacePainter painter(level_set, options);
  Image image(options.width, options.height, 3);
  std::atomic<std::uint64_t> rows_done{0};
  tbb::parallel_for(0, options.height, [&](int y) {
    throw_if_cancelled(progress);
    painter.paint_row(y, image);
    if (progress != nullptr) progress->advance(++rows_done, static_cast<std::uint64_t>(options.height));
  });
  return image;
}

}  // namespace solidnoise
