#include "solidnoise/volume/preview/preview.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/RayIntersector.h>
#include <openvdb/tools/RayTracer.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "solidnoise/volume/preview/preview_view.h"

namespace solidnoise {
namespace {

using openvdb::Vec3d;
using openvdb::tools::Film;
using Intersector = openvdb::tools::VolumeRayIntersector<openvdb::FloatGrid>;
using Renderer = openvdb::tools::VolumeRender<Intersector, openvdb::tools::BoxSampler>;

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

void develop(const Film& light, Image& image) {
  for (int y = 0; y < image.height; ++y) {
    const Vec3d background = sky(1.0 - (y + 0.5) / image.height);
    for (int x = 0; x < image.width; ++x) {
      const Film::RGBA& pixel = light.pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
      const Vec3d lit(pixel.r, pixel.g, pixel.b);
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y, channel) =
            encode_light(lit[channel] + kAmbient[channel] * pixel.a + background[channel] * (1.0 - pixel.a));
      }
    }
  }
}

// Steps through a volume that is clear may be this much longer than through one that is not: primary ones,
// and those of rays to a light over primary ones, in which errors are averaged over all that look at them.
// Where a voxel takes much light away they are shorter: the first one would count for nearly all, and where
// it falls would show as stripes on faces that were cut.
constexpr double kLongestStep = 2.0;
constexpr double kShortestStep = 0.5;
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
  if (grid.activeVoxelCount() == 0) return sum;

  const Camera place = frame_grid(framing_grid(grid, options), view, options.width, options.height);
  Film film(width, height);
  openvdb::tools::PerspectiveCamera camera(film, Vec3d(0.0), place.eye, 0.5, place.tan_x,
                                           1e-6 * place.eye.length() + 1e-9);
  camera.lookAt(place.eye - view.back, view.up);

  // Steps of about a pixel where voxels are smaller than that, else such that a fifth of the light goes:
  // where a voxel takes little light away, rays go all the way through, and light changes slowly along them.
  const openvdb::Coord extent = grid.evalActiveVoxelBoundingBox().dim();
  const double voxels_per_pixel =
      std::max({extent.x(), extent.y(), extent.z()}) / static_cast<double>(std::min(width, height));
  const double clarity = clarity_of(grid);
  const double step = std::max(voxels_per_pixel, std::clamp(clarity, kShortestStep, kLongestStep));

  constexpr int kDilation = 1;  // voxels: where values are interpolated between the grid's and its background
  const Intersector intersector(grid, kDilation);
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
  require_picture(grid, options);
  const Film light = render_lights(grid, options, progress);
  throw_if_cancelled(progress);
  Image image(options.width, options.height, 3);
  develop(light, image);
  return image;
}

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
        vertical_(options.up == UpAxis::y ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1)),
        to_sun_((-0.85 * view_.right + 0.70 * vertical_ + 0.25 * view_.back).unit()) {
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
