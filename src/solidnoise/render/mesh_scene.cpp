#include "solidnoise/render/mesh_scene.h"

#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <limits>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Those that can be seen: of finite corners.
std::vector<Triangle> visible_triangles(const PolygonMesh& mesh) {
  std::vector<Triangle> triangles = triangulate(mesh);
  std::erase_if(triangles, [&](const Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      const Vec<3>& p = mesh.positions[vertex];
      return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    });
  });
  return triangles;
}

std::vector<glm::vec3> normalized_positions(const PolygonMesh& mesh, std::span<const Triangle> triangles) {
  Vec<3> lower(kInfinity);
  Vec<3> upper(-kInfinity);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      lower = glm::min(lower, mesh.positions[vertex]);
      upper = glm::max(upper, mesh.positions[vertex]);
    }
  }
  const Vec<3> middle = 0.5 * (lower + upper);
  const double radius = 0.5 * glm::length(upper - lower);
  const double scale = radius > 0.0 ? 1.0 / radius : 1.0;
  std::vector<glm::vec3> positions(mesh.positions.size(), glm::vec3(0.0f));
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) {
      positions[vertex] = glm::vec3(scale * (mesh.positions[vertex] - middle));
    }
  }
  return positions;
}

RTCRay to_ray(const MeshScene::Ray& ray, float least) {
  RTCRay rtc{};
  rtc.org_x = ray.origin.x;
  rtc.org_y = ray.origin.y;
  rtc.org_z = ray.origin.z;
  rtc.dir_x = ray.direction.x;
  rtc.dir_y = ray.direction.y;
  rtc.dir_z = ray.direction.z;
  rtc.tnear = least;
  rtc.tfar = kInfinity;
  rtc.mask = ~0u;
  return rtc;
}

}  // namespace

struct MeshScene::Tracer {
  Tracer(std::span<const Triangle> triangles, std::span<const glm::vec3> positions)
      : device(rtcNewDevice(nullptr)) {
    if (!device) throw std::runtime_error("Embree, which casts the rays of previews, does not start");
    scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(Triangle), triangles.size());
    void* const vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof(glm::vec3), positions.size());
    if (corners && vertices) {
      std::copy(triangles.begin(), triangles.end(), static_cast<Triangle*>(corners));
      std::copy(positions.begin(), positions.end(), static_cast<glm::vec3*>(vertices));
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcCommitScene(scene);
    }
    rtcReleaseGeometry(geometry);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
      rtcReleaseScene(scene);
      rtcReleaseDevice(device);
      throw std::runtime_error("Embree cannot take the mesh; there may be too little memory");
    }
  }
  ~Tracer() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  RTCDevice device;
  RTCScene scene = nullptr;
};

MeshScene::MeshScene(const PolygonMesh& mesh)
    : triangles_(visible_triangles(mesh)), positions_(normalized_positions(mesh, triangles_)) {
  if (!triangles_.empty()) tracer_ = std::make_unique<Tracer>(triangles_, positions_);
}

MeshScene::~MeshScene() = default;

std::optional<MeshScene::Hit> MeshScene::nearest(const Ray& ray) const {
  if (!tracer_) return std::nullopt;
  RTCRayHit query{};
  query.ray = to_ray(ray, 0.0f);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(tracer_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool MeshScene::blocked(const Ray& ray, float least) const {
  if (!tracer_) return false;
  RTCRay query = to_ray(ray, least);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(tracer_->scene, &context, &query);
  return query.tfar < 0.0f;
}

}  // namespace solidnoise
