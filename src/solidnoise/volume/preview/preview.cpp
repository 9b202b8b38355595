#include "solidnoise/volume/preview/preview.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <openvdb/tools/RayTracer.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/volume/statistics.h"

namespace solidnoise {
namespace {

using openvdb::Vec3d;
using openvdb::tools::Film;
using Intersector = openvdb::tools::VolumeRayIntersector<openvdb::FloatGrid>;
using Renderer = openvdb::tools::VolumeRender<Intersector, openvdb::tools::BoxSampler>;

constexpr double kHalfFieldOfView = 0.27;  // tangent, of the picture's shorter side
constexpr double kMargin = 1.12;           // of the picture over what must be in it

// A frame of reference for looking: x to the right, y up, z towards the camera.
struct View {
  Vec3d right;
  Vec3d up;
  Vec3d back;
};

View three_quarter_view(UpAxis axis) {
  const Vec3d vertical = axis == UpAxis::y ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1);
  const Vec3d front = axis == UpAxis::y ? Vec3d(0, 0, 1) : Vec3d(0, -1, 0);
  const Vec3d side = vertical.cross(front);
  View view;
  view.back = (0.55 * side + 0.32 * vertical + front).unit();
  view.right = vertical.cross(view.back).unit();
  view.up = view.back.cross(view.right);
  return view;
}

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

// One directional light, as VolumeRender takes it.
struct Light {
  Vec3d direction;         // towards it
  Vec3d colour;            // linear light
  double gain = 0.0;       // how much of what is scattered away still arrives; imitates multiple scattering
  double shadow_step = 2;  // voxels
};

// A white cloud scatters nearly all it takes away, so its shadows are soft and bright: a sun that mostly
// lights what it sees, a part of it that seeps in, and the sky above. What comes from all around is added as
// a constant.
std::vector<Light> make_lights(const View& view, UpAxis axis) {
  const Vec3d vertical = axis == UpAxis::y ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1);
  const Vec3d sun = (-0.85 * view.right + 0.70 * vertical + 0.25 * view.back).unit();
  return {
      {sun, {0.79, 0.76, 0.69}, 0.02, 1.5},
      {sun, {0.24, 0.23, 0.22}, 0.4, 3.0},
      {(vertical + 0.25 * view.back + 0.2 * view.right).unit(), {0.14, 0.18, 0.25}, 0.2, 3.0},
  };
}
const Vec3d kAmbient(0.07, 0.09, 0.125);

// Renders one light's part in parallel, and adds it to `sum`: colour times coverage, and coverage.
class LightPass {
 public:
  LightPass(const openvdb::FloatGrid& grid, const Intersector& intersector) : intersector_(intersector) {
    const double voxel = grid.voxelSize().x();
    scattering_ = voxel;  // VolumeRender integrates over voxels, our densities are per world unit
    // It uses one number as the least density and the least squared transmittance that matter. A density of
    // 2e-4 per voxel is a depth of 0.05 over 256 voxels.
    cut_off_ = std::clamp(2e-4 / voxel, 1e-6, 1e-3);
  }

  void render(const Light& light, openvdb::tools::BaseCamera& camera, double step, Progress* progress,
              std::atomic<std::uint64_t>& rows_done, std::uint64_t rows) const {
    Renderer renderer(intersector_, camera);
    renderer.setLightDir(light.direction.x(), light.direction.y(), light.direction.z());
    renderer.setLightColor(light.colour.x(), light.colour.y(), light.colour.z());
    renderer.setLightGain(light.gain);
    renderer.setScattering(scattering_, scattering_, scattering_);
    renderer.setAbsorption(0, 0, 0);
    renderer.setPrimaryStep(step);
    renderer.setShadowStep(step * light.shadow_step);
    renderer.setCutOff(cut_off_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, camera.height(), 4), [&](const auto& range) {
      throw_if_cancelled(progress);
      const Renderer own(renderer);  // its ray intersectors have a state
      own(range);
      if (progress != nullptr) progress->advance(rows_done += range.size(), rows);
    });
  }

 private:
  const Intersector& intersector_;
  double scattering_ = 1.0;
  double cut_off_ = 1e-3;
};

// A clear sky, paler towards the horizon; `height` is 0 at the bottom of the picture and 1 at the top.
Vec3d sky(double height) {
  const Vec3d low(0.36, 0.54, 0.78);
  const Vec3d high(0.07, 0.19, 0.47);
  return low + (high - low) * std::pow(height, 0.8);
}

// Linear light to display: highlights are rolled off above 0.6, then the sRGB curve (IEC 61966-2-1).
float encode(double linear) {
  constexpr double kShoulder = 0.6;
  if (linear > kShoulder)
    linear = 1.0 - (1.0 - kShoulder) * std::exp(-(linear - kShoulder) / (1.0 - kShoulder));
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<float>(std::clamp(encoded, 0.0, 1.0));
}

void develop(const Film& light, Image& image) {
  for (int y = 0; y < image.height; ++y) {
    const Vec3d background = sky(1.0 - (y + 0.5) / image.height);
    for (int x = 0; x < image.width; ++x) {
      const Film::RGBA& pixel = light.pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
      const Vec3d lit(pixel.r, pixel.g, pixel.b);
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y, channel) =
            encode(lit[channel] + kAmbient[channel] * pixel.a + background[channel] * (1.0 - pixel.a));
      }
    }
  }
}

// Steps through a volume that is clear may be this much longer than through one that is not: primary ones,
// and those of rays to a light over primary ones, in which errors are averaged over all that look at them.
constexpr double kLongestStep = 2.0;
constexpr double kLongestShadowStep = 3.0;

// Voxels that take away a fifth of a light, on the mean where there is anything.
double clarity_of(const openvdb::FloatGrid& grid) {
  constexpr double kOpticalDepth = 0.2;
  double sum = 0.0;
  std::uint64_t count = 0;
  for (auto value = grid.cbeginValueOn(); value; ++value) {
    if (*value <= 0.0f) continue;
    sum += static_cast<double>(*value) * static_cast<double>(value.getVoxelCount());
    count += value.getVoxelCount();
  }
  if (count == 0) return 1.0;
  return kOpticalDepth * static_cast<double>(count) / (sum * grid.voxelSize().x());
}

// Everything that all lights shine on.
Film render_lights(const openvdb::FloatGrid& grid, const PreviewOptions& options, Progress* progress) {
  const auto width = static_cast<std::size_t>(options.width);
  const auto height = static_cast<std::size_t>(options.height);
  Film sum(width, height, Film::RGBA(0.0f, 0.0f, 0.0f, 0.0f));
  const View view = three_quarter_view(options.up);
  const std::vector<Vec3d> points = outline(grid, view);
  if (points.empty()) return sum;

  const double shorter = std::min(options.width, options.height);
  const double tan_x = kHalfFieldOfView * options.width / shorter;
  const double tan_y = kHalfFieldOfView * options.height / shorter;
  const Vec3d eye = camera_position(points, view, tan_x, tan_y);
  Film film(width, height);
  openvdb::tools::PerspectiveCamera camera(film, Vec3d(0.0), eye, 0.5, tan_x, 1e-6 * eye.length() + 1e-9);
  camera.lookAt(eye - view.back, view.up);

  // Steps of a voxel, or of about a pixel where voxels are smaller. Where a voxel takes little light away,
  // longer ones: rays go all the way through then, and light changes slowly along them.
  const openvdb::Coord extent = grid.evalActiveVoxelBoundingBox().dim();
  const double voxels_per_pixel = std::max({extent.x(), extent.y(), extent.z()}) / shorter;
  const double clarity = clarity_of(grid);
  const double step = std::max({1.0, voxels_per_pixel, std::min(clarity, kLongestStep)});

  const Intersector intersector(grid);
  const LightPass pass(grid, intersector);
  std::vector<Light> lights = make_lights(view, options.up);
  std::atomic<std::uint64_t> rows_done{0};
  for (Light& light : lights) {
    light.shadow_step *= std::clamp(clarity, 1.0, kLongestShadowStep);
    pass.render(light, camera, step, progress, rows_done, lights.size() * height);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const float coverage = film.pixel(x, y).a;
        sum.pixel(x, y) += film.pixel(x, y);
        sum.pixel(x, y).a = coverage;  // the same for each light
      }
    }
  }
  return sum;
}

}  // namespace

Image render_preview(const openvdb::FloatGrid& grid, const PreviewOptions& options, Progress* progress) {
  require_in_range("the preview's width", options.width, 16, 8192, "pixels");
  require_in_range("the preview's height", options.height, 16, 8192, "pixels");
  if (!grid.hasUniformVoxels()) throw std::invalid_argument("a preview needs voxels that are cubes");
  const Film light = render_lights(grid, options, progress);
  throw_if_cancelled(progress);
  Image image(options.width, options.height, 3);
  develop(light, image);
  return image;
}

}  // namespace solidnoise
