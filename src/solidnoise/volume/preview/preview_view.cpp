#include "solidnoise/volume/preview/preview_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

using openvdb::Vec3d;

constexpr double kHalfFieldOfView = 0.27;  // tangent, of the picture's shorter side
constexpr double kMargin = 1.12;           // of the picture over what must be in it

// A corner of each leaf and tile that holds something, in the view's coordinates.
std::vector<Vec3d> outline(const openvdb::FloatGrid& grid, const View& view) {
  std::vector<Vec3d> points;
  const auto add = [&](const openvdb::CoordBBox& box) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d index((corner & 1) ? box.max().x() : box.min().x(),
                        (corner & 2) ? box.max().y() : box.min().y(),
                        (corner & 4) ? box.max().z() : box.min().z());
      const Vec3d world = grid.indexToWorld(index);
      points.emplace_back(world.dot(view.right), world.dot(view.up), world.dot(view.back));
    }
  };
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    if (!leaf->isEmpty()) add(leaf->getNodeBoundingBox());
  }
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    add(box);
  }
  return points;
}

// The place from which all points are in the picture, in the middle of it.
Vec3d camera_position(const std::vector<Vec3d>& points, const View& view, double tan_x, double tan_y) {
  Vec3d low = points.front();
  Vec3d high = points.front();
  for (const Vec3d& point : points) {
    low = openvdb::math::minComponent(low, point);
    high = openvdb::math::maxComponent(high, point);
  }
  const Vec3d middle = 0.5 * (low + high);
  double distance = high.z();
  for (const Vec3d& point : points) {
    distance = std::max({distance, point.z() + std::abs(point.x() - middle.x()) * kMargin / tan_x,
                         point.z() + std::abs(point.y() - middle.y()) * kMargin / tan_y});
  }
  return middle.x() * view.right + middle.y() * view.up + distance * view.back;
}

}  // namespace

Vec3d vertical(UpAxis axis) {
  return axis == UpAxis::y ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1);
}

View three_quarter_view(UpAxis axis) {
  const Vec3d above = vertical(axis);
  const Vec3d front = axis == UpAxis::y ? Vec3d(0, 0, 1) : Vec3d(0, -1, 0);
  const Vec3d side = above.cross(front);
  View view;
  view.back = (0.55 * side + 0.32 * above + front).unit();
  view.right = above.cross(view.back).unit();
  view.up = view.back.cross(view.right);
  return view;
}

Vec3d direction_to_sun(UpAxis axis) {
  const View view = three_quarter_view(axis);
  return (-0.85 * view.right + 0.70 * vertical(axis) + 0.25 * view.back).unit();
}

Vec3d direction_at(const Camera& camera, const View& view, double x, double y) {
  const double across = (2.0 * x - 1.0) * camera.tan_x;
  const double upwards = (1.0 - 2.0 * y) * camera.tan_y;
  return (across * view.right + upwards * view.up - view.back).unit();
}

const openvdb::FloatGrid& framing_grid(const openvdb::FloatGrid& shown, const PreviewOptions& options) {
  return options.frame && options.frame->activeVoxelCount() > 0 ? *options.frame : shown;
}

Camera frame_grid(const openvdb::FloatGrid& grid, const View& view, int width, int height) {
  const double shorter = std::min(width, height);
  Camera camera;
  camera.tan_x = kHalfFieldOfView * width / shorter;
  camera.tan_y = kHalfFieldOfView * height / shorter;
  camera.eye = camera_position(outline(grid, view), view, camera.tan_x, camera.tan_y);
  return camera;
}

Vec3d sky(double height) {
  const Vec3d low(0.36, 0.54, 0.78);
  const Vec3d high(0.07, 0.19, 0.47);
  return low + (high - low) * std::pow(height, 0.8);
}

float encode_light(double linear) {
  constexpr double kShoulder = 0.6;
  if (linear > kShoulder)
    linear = 1.0 - (1.0 - kShoulder) * std::exp(-(linear - kShoulder) / (1.0 - kShoulder));
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<float>(std::clamp(encoded, 0.0, 1.0));
}

void require_picture(const openvdb::FloatGrid& grid, const PreviewOptions& options) {
  require_in_range("the preview's width", options.width, 16, 8192, "pixels");
  require_in_range("the preview's height", options.height, 16, 8192, "pixels");
  if (!grid.hasUniformVoxels()) throw std::invalid_argument("a preview needs voxels that are cubes");
}

}  // namespace solidnoise
