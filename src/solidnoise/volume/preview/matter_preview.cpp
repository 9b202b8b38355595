#include "solidnoise/volume/preview/matter_preview.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/RayIntersector.h>

#include "solidnoise/image/color.h"
#include "solidnoise/volume/preview/light_field.h"
#include "solidnoise/volume/preview/preview_view.h"

namespace solidnoise {
namespace {

using openvdb::Vec3d;
using Intersector = openvdb::tools::VolumeRayIntersector<openvdb::FloatGrid>;
using Ray = Intersector::RayType;
using Sampler = openvdb::tools::BoxSampler;

// What is to be seen, beside what glows.
struct Scene {
  MakeMatter make_matter;
  Vec3d dimming{1.0, 1.0, 1.0};              // of each channel, over the extinction
  Vec3d albedo{1.0, 1.0, 1.0};               // of what suns light
  Vec3d ambient{0.0, 0.0, 0.0};              // linear light from all around
  std::vector<Sun> suns{};                   // none: nothing is lit
  Vec3d (*behind)(double height) = nullptr;  // as sky(); null: black
};

double longest_side(const openvdb::FloatGrid& grid) {
  const openvdb::Coord dim = grid.evalActiveVoxelBoundingBox().dim();
  return std::max({dim.x(), dim.y(), dim.z()}) * grid.voxelSize().x();
}

// Walks rays through the active voxels of `hull`.
class MatterPainter {
 public:
  MatterPainter(const openvdb::FloatGrid& hull, const Scene& scene, const PreviewOptions& options)
      : hull_(hull), scene_(scene), options_(options), view_(three_quarter_view(options.up)) {
    if (hull.activeVoxelCount() == 0) return;
    intersector_.emplace(hull, 1);
    camera_ = frame_grid(framing_grid(hull, options), view_, options.width, options.height);
    const openvdb::Coord dim = hull.evalActiveVoxelBoundingBox().dim();
    const double voxels_per_pixel =
        std::max({dim.x(), dim.y(), dim.z()}) / static_cast<double>(std::min(options.width, options.height));
    step_ = std::max(0.75, voxels_per_pixel);
    if (scene.suns.empty()) return;
    light_.emplace(hull.evalActiveVoxelBoundingBox(), hull.voxelSize().x(), scene.suns, scene.make_matter);
  }

  void paint_row(int y, Image& image) const {
    std::optional<Intersector> intersector = intersector_;  // it has a state
    const MatterAt matter_at = scene_.make_matter();
    const double down = (y + 0.5) / options_.height;
    const Vec3d background = scene_.behind ? scene_.behind(1.0 - down) : Vec3d(0.0);
    for (int x = 0; x < options_.width; ++x) {
      Vec3d clear(1.0);
      Vec3d light(0.0);
      if (intersector) look((x + 0.5) / options_.width, down, *intersector, matter_at, light, clear);
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y, channel) = encode_light(light[channel] + clear[channel] * background[channel]);
      }
    }
  }

 private:
  // The light from a place of the picture, and what comes through of what is behind.
  void look(double x, double y, Intersector& intersector, const MatterAt& matter_at, Vec3d& light,
            Vec3d& clear) const {
    const Vec3d eye = hull_.worldToIndex(camera_.eye);
    const Ray ray(eye, direction_at(camera_, view_, x, y));  // a unit of it is a voxel, for they are cubes
    if (!intersector.setIndexRay(ray)) return;
    double first = 0.0;
    double last = 0.0;
    while (intersector.march(first, last)) {
      double t = std::ceil(first / step_) * step_;
      Matter matter = matter_at(ray(t));
      for (; t < last; t += step_) {
        const Matter next = matter_at(ray(t + step_));
        const double extinction = std::max(matter.extinction, next.extinction);
        const int parts = parts_of_step(extinction);
        for (int part = 0; part < parts; ++part) {
          const double place = t + step_ * part / parts;
          add(part == 0 ? matter : matter_at(ray(place)), ray(place), step_ / parts, light, clear);
        }
        matter = next;
        if (std::max({clear[0], clear[1], clear[2]}) < 0.01) return;
      }
    }
  }

  // Into as many a step is divided that each takes little light away: else the first one would count for
  // nearly all, and where it falls would show as hatching.
  int parts_of_step(double extinction) const {
    constexpr double kMostDepth = 0.15;
    constexpr double kMostParts = 16.0;
    const double depth = extinction * step_ * hull_.voxelSize().x();
    return static_cast<int>(std::clamp(std::ceil(depth / kMostDepth), 1.0, kMostParts));
  }

  // What `length` voxels of some matter send, and what they let through.
  void add(const Matter& matter, const Vec3d& place, double length, Vec3d& light, Vec3d& clear) const {
    if (matter.extinction <= 0.0 && matter.emission == Vec3d(0.0)) return;
    const double units = length * hull_.voxelSize().x();
    Vec3d source = matter.emission;
    if (light_) source += matter.extinction * scene_.albedo * (scene_.ambient + light_->at(place));
    for (int channel = 0; channel < 3; ++channel) {
      const double depth = matter.extinction * scene_.dimming[channel] * units;
      const double through = std::exp(-depth);
      // The mean of what is left over the step, of 1 at its beginning.
      const double mean = depth > 1e-4 ? (1.0 - through) / depth : 1.0;
      light[channel] += clear[channel] * source[channel] * mean * units;
      clear[channel] *= through;
    }
  }

  const openvdb::FloatGrid& hull_;
  const Scene& scene_;
  const PreviewOptions& options_;
  const View view_;
  std::optional<Intersector> intersector_;
  std::optional<LightField> light_;
  Camera camera_;
  double step_ = 1.0;  // voxels
};

// Linear light of a black body, with 1 for the mean of its channels at 2000 K: Wien's law at 610, 549 and
// 464 nm, white at 6500 K, and the light of all wavelengths after Stefan and Boltzmann.
Vec3d black_body(double kelvin) {
  constexpr double kSecondRadiation = 1.4388e7;  // nm K
  constexpr double kWhite = 6500.0;
  const Vec3d wavelengths(610.0, 549.0, 464.0);
  Vec3d colour;
  for (int channel = 0; channel < 3; ++channel) {
    colour[channel] = std::exp(-kSecondRadiation / wavelengths[channel] * (1.0 / kelvin - 1.0 / kWhite));
  }
  return colour * (3.0 / (colour[0] + colour[1] + colour[2]) * std::pow(kelvin / 2000.0, 4));
}

// An overcast sky, in linear light.
Vec3d haze(double height) {
  return Vec3d(0.68, 0.68, 0.67) + (0.22 * height) * Vec3d(-1.0, -0.95, -0.85);
}

// A white cloud scatters nearly all it takes away, so its shadows are soft and bright: a sun that mostly
// lights what it sees, a part of it that seeps in, and the sky above. What comes from all around is added as
// a constant.
Image render_sunlit(const openvdb::FloatGrid& grid, Scene scene, const PreviewOptions& options,
                    Progress* progress) {
  require_picture(grid, options);
  const View view = three_quarter_view(options.up);
  const Vec3d to_sun = direction_to_sun(options.up);
  const Vec3d to_sky = (vertical(options.up) + 0.25 * view.back + 0.2 * view.right).unit();
  scene.suns = {{to_sun, {0.79, 0.76, 0.69}, 0.8},
                {to_sun, {0.24, 0.23, 0.22}, 0.15},
                {to_sky, {0.15, 0.18, 0.22}, 0.24}};
  scene.make_matter = [&]() -> MatterAt {
    return [density = grid.getConstAccessor()](const Vec3d& index) {
      return Matter{std::max(0.0f, Sampler::sample(density, index)), {0.0, 0.0, 0.0}};
    };
  };
  return paint(MatterPainter(grid, scene, options), options, progress);
}

}  // namespace

Image render_preview(const openvdb::FloatGrid& grid, const PreviewOptions& options, Progress* progress) {
  Scene scene;
  scene.behind = sky;
  scene.ambient = {0.085, 0.098, 0.117};
  return render_sunlit(grid, scene, options, progress);
}

Image render_smoke(const openvdb::FloatGrid& grid, const PreviewOptions& options, Progress* progress) {
  Scene scene;
  scene.behind = haze;
  scene.albedo = {0.28, 0.272, 0.265};
  scene.ambient = {0.017, 0.017, 0.017};
  return render_sunlit(grid, scene, options, progress);
}

Image render_fire(const FireGrids& fire, const PreviewOptions& options, Progress* progress) {
  require_picture(*fire.density, options);
  const openvdb::FloatGrid::Ptr hull = fire.density->deepCopy();
  hull->topologyUnion(*fire.temperature);
  constexpr double kColdest = 500.0;  // K, below which nothing is seen to glow
  constexpr double kLight = 8.0;      // of what glows fully at 2000 K, through a whole volume of it
  const double light = kLight / std::max(longest_side(*hull), 1e-30);
  Scene scene;
  scene.albedo = {0.45, 0.42, 0.39};
  scene.ambient = {0.05, 0.06, 0.085};
  scene.suns = {{direction_to_sun(options.up), {0.60, 0.57, 0.54}, 0.5}};
  scene.make_matter = [&]() -> MatterAt {
    return [density = fire.density->getConstAccessor(), temperature = fire.temperature->getConstAccessor(),
            flame = (fire.flame ? fire.flame : fire.temperature)->getConstAccessor(),
            glows_by_flame = fire.flame != nullptr, light](const Vec3d& index) {
      Matter matter{std::max(0.0f, Sampler::sample(density, index)), {0.0, 0.0, 0.0}};
      const double kelvin = Sampler::sample(temperature, index);
      if (kelvin < kColdest) return matter;
      const double share = glows_by_flame ? std::max(0.0f, Sampler::sample(flame, index)) : 1.0;
      if (share > 0.0) matter.emission = light * share * black_body(kelvin);
      return matter;
    };
  };
  return paint(MatterPainter(*hull, scene, options), options, progress);
}

Image render_nebula(const openvdb::FloatGrid& density, const PreviewOptions& options, Progress* progress) {
  require_picture(density, options);
  float peak = 0.0f;
  for (auto value = density.cbeginValueOn(); value; ++value) peak = std::max(peak, *value);
  const ColorRamp ramp({{0.0f, {0.02f, 0.10f, 0.30f}},
                        {0.12f, {0.10f, 0.36f, 0.62f}},
                        {0.3f, {0.62f, 0.25f, 0.55f}},
                        {0.55f, {0.95f, 0.50f, 0.35f}},
                        {1.0f, {1.0f, 0.93f, 0.75f}}});
  constexpr double kLight = 1.2;  // of what is opaque and densest
  Scene scene;
  scene.dimming = {0.35, 0.55, 0.8};
  scene.make_matter = [&]() -> MatterAt {
    return [values = density.getConstAccessor(), &ramp, peak](const Vec3d& index) {
      const float value = std::max(0.0f, Sampler::sample(values, index));
      if (value == 0.0f) return Matter{};
      const Color colour = ramp.linear(std::sqrt(value / peak));
      return Matter{value, kLight * value * Vec3d(colour.x, colour.y, colour.z)};
    };
  };
  return paint(MatterPainter(density, scene, options), options, progress);
}

}  // namespace solidnoise
