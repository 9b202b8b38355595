#include "solidnoise/render/render_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/core/check.h"
#include "solidnoise/core/random.h"
#include "solidnoise/render/mesh_scene.h"

namespace solidnoise {
namespace {

constexpr float kTangent = 0.3f;       // of half the field of view, along the picture's shorter side
constexpr float kMargin = 1.08f;       // of the picture over what must be in it
constexpr int kSubpixels = 3;          // along each side of a pixel
constexpr int kSkyRays = 6;            // per subpixel
constexpr float kLeastShadow = 2e-4f;  // of the mesh's radius: nearer than this nothing casts a shadow

// Sun and sky make 1 on what faces the sky at 45 degrees from the sun.
const Color kSun(1.02f, 0.97f, 0.89f);
const Color kSky(0.33f, 0.35f, 0.385f);
const Color kGround(0.12f, 0.11f, 0.1f);
const Color kBackgroundLow(0.62f, 0.62f, 0.62f);
const Color kBackgroundHigh(0.34f, 0.36f, 0.39f);

// A frame of reference for looking: x to the right, y up, z towards the camera.
struct View {
  glm::vec3 vertical;
  glm::vec3 right;
  glm::vec3 up;
  glm::vec3 back;
};

View view_of(const MeshPictureOptions& options) {
  constexpr double kThreeQuarters = 28.8;  // degrees to the right of the front
  View view;
  view.vertical = options.up == UpAxis::y ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 front = options.up == UpAxis::y ? glm::vec3(0, 0, 1) : glm::vec3(0, -1, 0);
  const glm::vec3 side = glm::cross(view.vertical, front);
  const auto turn = static_cast<float>(glm::radians(kThreeQuarters + options.turn));
  const auto elevation = static_cast<float>(glm::radians(options.elevation));
  view.back = std::cos(elevation) * (std::cos(turn) * front + std::sin(turn) * side) +
              std::sin(elevation) * view.vertical;
  view.right = glm::normalize(glm::cross(view.vertical, view.back));
  view.up = glm::cross(view.back, view.right);
  return view;
}

// Where the camera stands, and how far it sees to each side at distance 1.
struct Camera {
  View view;
  glm::vec3 position{0.0f};
  glm::vec2 tangent{1.0f};

  Camera(const MeshScene& scene, const MeshPictureOptions& options) : view(view_of(options)) {
    const auto shorter = static_cast<float>(std::min(options.width, options.height));
    tangent = kTangent / shorter * glm::vec2(options.width, options.height);
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    const auto for_each_corner = [&](const auto& visit) {
      for (const Triangle& triangle : scene.triangles()) {
        for (const std::uint32_t vertex : triangle) {
          const glm::vec3& p = scene.positions()[vertex];
          visit(glm::vec3(glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.back)));
        }
      }
    };
    for_each_corner([&](const glm::vec3& p) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    });
    const glm::vec3 middle = 0.5f * (low + high);
    float distance = high.z + 0.1f;
    for_each_corner([&](const glm::vec3& p) {
      distance = std::max({distance, p.z + std::abs(p.x - middle.x) * kMargin / tangent.x,
                           p.z + std::abs(p.y - middle.y) * kMargin / tangent.y});
    });
    position = middle.x * view.right + middle.y * view.up + distance * view.back;
  }

  // Through a point of the picture, from -1 to 1 to the right and up.
  MeshScene::Ray ray(const glm::vec2& at) const {
    return {position, glm::normalize(at.x * tangent.x * view.right + at.y * tangent.y * view.up - view.back)};
  }
};

// Fraction of n / base^k's digits mirrored: evenly spread numbers in [0, 1).
float radical_inverse(unsigned n, unsigned base) {
  float result = 0.0f;
  float digit = 1.0f / static_cast<float>(base);
  for (; n > 0; n /= base, digit /= static_cast<float>(base)) result += digit * static_cast<float>(n % base);
  return result;
}

// Of unit length, at right angles to `normal` and to each other.
std::array<glm::vec3, 2> tangents_of(const glm::vec3& normal) {
  const glm::vec3 other = std::abs(normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 first = glm::normalize(glm::cross(normal, other));
  return {first, glm::cross(normal, first)};
}

// The mesh, its normals and colours under sun and sky.
class Shader {
 public:
  Shader(const MeshScene& scene, const View& view, std::span<const Vec<3>> normals,
         std::span<const Color> colors)
      : scene_(scene),
        normals_(normals),
        colors_(colors),
        vertical_(view.vertical),
        sun_(glm::normalize(-0.75f * view.right + 0.75f * view.vertical + 0.55f * view.back)) {
    for (const Triangle& triangle : scene.triangles()) {
      for (const std::uint32_t vertex : triangle) {
        const float height = glm::dot(scene.positions()[vertex], vertical_);
        ground_ = std::min(ground_, height);
        top_ = std::max(top_, height);
      }
    }
  }

  // Linear light that comes back along the ray. `sample` is the number of the picture's subpixel.
  Color shade(const MeshScene::Ray& ray, const MeshScene::Hit& hit, unsigned sample) const {
    const Triangle& triangle = scene_.triangles()[hit.triangle];
    const std::array<float, 3> weights{1.0f - hit.u - hit.v, hit.u, hit.v};
    Color color(0.0f);
    glm::vec3 normal(0.0f);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      color += weights[corner] * colors_[triangle[corner]];
      normal += weights[corner] * glm::vec3(normals_[triangle[corner]]);
    }
    glm::vec3 facet = facet_normal(triangle);
    if (glm::dot(facet, ray.direction) > 0.0f) facet = -facet;
    normal = glm::dot(normal, normal) > 1e-12f ? glm::normalize(normal) : facet;
    if (glm::dot(normal, facet) < 0.0f) normal = -normal;

    const glm::vec3 at = ray.origin + hit.distance * ray.direction + kLeastShadow * facet;
    Color light = sky_light(at, normal, sample);
    const float toward_sun = glm::dot(normal, sun_);
    if (toward_sun > 0.0f && !scene_.blocked({at, sun_}, kLeastShadow)) light += toward_sun * kSun;
    return color * light;
  }

  // What is left of the light on the ground where the ray meets it, of what there is without the mesh.
  Color ground_shadow(const MeshScene::Ray& ray, unsigned sample) const {
    const float fall = -glm::dot(ray.direction, vertical_);
    const float height = glm::dot(ray.origin, vertical_) - ground_;
    if (!(fall > 1e-3f && height > 0.0f) || ground_ >= top_) return Color(1.0f);
    const glm::vec3 at = ray.origin + height / fall * ray.direction + kLeastShadow * vertical_;
    const Color sun = glm::dot(vertical_, sun_) * kSun;
    Color light = sky_light(at, vertical_, sample);
    if (!scene_.blocked({at, sun_}, kLeastShadow)) light += sun;
    return light / (sun + open_sky(vertical_, sample));
  }

 private:
  glm::vec3 facet_normal(const Triangle& triangle) const {
    const auto positions = scene_.positions();
    const glm::vec3 cross = glm::cross(positions[triangle[1]] - positions[triangle[0]],
                                       positions[triangle[2]] - positions[triangle[0]]);
    const float length = glm::length(cross);
    return length > 0.0f ? cross / length : vertical_;
  }

  Color sky_light(const glm::vec3& at, const glm::vec3& normal, unsigned sample) const {
    return sky_light(normal, sample, [&](const glm::vec3& direction) {
      return scene_.blocked({at, direction}, kLeastShadow);
    });
  }
  // The same where nothing is in the way.
  Color open_sky(const glm::vec3& normal, unsigned sample) const {
    return sky_light(normal, sample, [](const glm::vec3&) { return false; });
  }

  // From directions that are spread as the cosine to the normal, evenly over a pixel, and turned from pixel
  // to pixel, or rows and columns of the picture would show.
  template <typename Blocked>
  Color sky_light(const glm::vec3& normal, unsigned sample, const Blocked& blocked) const {
    const auto [first, second] = tangents_of(normal);
    constexpr unsigned kOfPixel = kSubpixels * kSubpixels;
    RandomStream random(sample / kOfPixel);
    const auto start = static_cast<float>(random.next_unit());
    const auto rise = static_cast<float>(random.next_unit());
    Color sum(0.0f);
    for (unsigned k = 0; k < kSkyRays; ++k) {
      const unsigned n = sample % kOfPixel * kSkyRays + k;
      const float turn = 2.0f * std::numbers::pi_v<float> * (start + radical_inverse(n, 2));
      const float height = std::fmod(rise + radical_inverse(n, 3), 1.0f);
      const float width = std::sqrt(1.0f - height);
      const glm::vec3 direction =
          width * (std::cos(turn) * first + std::sin(turn) * second) + std::sqrt(height) * normal;
      if (blocked(direction)) continue;
      sum += glm::mix(kGround, kSky, 0.5f + 0.5f * glm::dot(direction, vertical_));
    }
    return sum / static_cast<float>(kSkyRays);
  }

  const MeshScene& scene_;
  std::span<const Vec<3>> normals_;
  std::span<const Color> colors_;
  glm::vec3 vertical_;
  glm::vec3 sun_;
  float ground_ = 1e9f;  // the heights of the lowest and the highest triangle's corners
  float top_ = -1e9f;
};

// Highlights are rolled off above 0.7, then encoded.
float develop(float linear) {
  constexpr float kShoulder = 0.7f;
  if (linear > kShoulder) {
    linear = 1.0f - (1.0f - kShoulder) * std::exp(-(linear - kShoulder) / (1.0f - kShoulder));
  }
  return std::clamp(srgb_from_linear(linear), 0.0f, 1.0f);
}

void require_size(const char* name, std::size_t size, std::size_t vertices) {
  if (size == vertices) return;
  throw std::invalid_argument(
      fmt::format("{} are {}; there must be one for each of the {} vertices", name, size, vertices));
}

}  // namespace

Image render_mesh(const PolygonMesh& mesh, std::span<const Vec<3>> normals, std::span<const Color> colors,
                  const MeshPictureOptions& options) {
  require_in_range("the picture's width", options.width, 16, 8192, "pixels");
  require_in_range("the picture's height", options.height, 16, 8192, "pixels");
  require_in_range("the camera's elevation", options.elevation, -85.0, 85.0, "degrees");
  require_size("normals", normals.size(), mesh.positions.size());
  require_size("colors", colors.size(), mesh.positions.size());

  const MeshScene scene(mesh);
  const Camera camera(scene, options);
  const Shader shader(scene, camera.view, normals, colors);
  Image image(options.width, options.height, 3);
  tbb::parallel_for(0, options.height, [&](int y) {
    for (int x = 0; x < options.width; ++x) {
      Color sum(0.0f);
      for (int sub = 0; sub < kSubpixels * kSubpixels; ++sub) {
        const float right =
            static_cast<float>(x) + (static_cast<float>(sub % kSubpixels) + 0.5f) / kSubpixels;
        const float down = static_cast<float>(y) + (static_cast<float>(sub / kSubpixels) + 0.5f) / kSubpixels;
        const glm::vec2 at(2.0f * right / static_cast<float>(options.width) - 1.0f,
                           1.0f - 2.0f * down / static_cast<float>(options.height));
        const MeshScene::Ray ray = camera.ray(at);
        const auto hit = scene.nearest(ray);
        const auto sample = static_cast<unsigned>((y * options.width + x) * kSubpixels * kSubpixels + sub);
        sum += hit ? shader.shade(ray, *hit, sample)
                   : glm::mix(kBackgroundLow, kBackgroundHigh, 0.5f + 0.5f * at.y) *
                         shader.ground_shadow(ray, sample);
      }
      for (int channel = 0; channel < 3; ++channel) {
        image.at(x, y, channel) = develop(sum[channel] / static_cast<float>(kSubpixels * kSubpixels));
      }
    }
  });
  return image;
}

}  // namespace solidnoise
