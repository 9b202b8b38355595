#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

namespace solidnoise {

// A mesh that rays can be cast at. Positions are those of the mesh, moved and scaled into a ball of radius 1
// around the origin. May be shared between threads.
class MeshScene {
 public:
  explicit MeshScene(const PolygonMesh& mesh);
  ~MeshScene();
  MeshScene(const MeshScene&) = delete;
  MeshScene& operator=(const MeshScene&) = delete;

  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const glm::vec3> positions() const { return positions_; }

  struct Ray {
    glm::vec3 origin;
    glm::vec3 direction;  // of unit length
  };
  // Where a ray meets a triangle: the corners' weights are 1 - u - v, u and v.
  struct Hit {
    std::size_t triangle = 0;
    float u = 0.0f;
    float v = 0.0f;
    float distance = 0.0f;
  };

  std::optional<Hit> nearest(const Ray& ray) const;
  // Whether the ray meets anything past `least` along it.
  bool blocked(const Ray& ray, float least) const;

 private:
  struct Tracer;  // keeps Embree out of this header

  std::vector<Triangle> triangles_;
  std::vector<glm::vec3> positions_;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace solidnoise
