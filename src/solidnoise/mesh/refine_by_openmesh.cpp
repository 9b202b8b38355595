#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LongestEdgeT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/geometry/openmesh_session.h"
#include "solidnoise/mesh/refine.h"

namespace solidnoise {
namespace {

using Method = RefineOptions::Method;

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using TriangleKernel = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

std::uint32_t index_of(OpenMesh::BaseHandle handle) {
  return static_cast<std::uint32_t>(handle.idx());
}

// A mesh that remembers, as LongestEdgeT splits one of its edges, the edge's ends.
class TriangleMesh : public TriangleKernel {
 public:
  TriangleMesh(const PolygonMesh& mesh, const RefineOptions& options) : options_(options) {
    for (const Vec<3>& p : mesh.positions) TriangleKernel::add_vertex({p.x, p.y, p.z});
    const OpenMeshSession session;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) add_triangle(f, mesh.face(f));
  }

  VertexHandle add_vertex(const Point& point) {
    require_vertices(n_vertices() + 1, options_);
    return TriangleKernel::add_vertex(point);
  }

  using TriangleKernel::split;
  void split(EdgeHandle edge, VertexHandle vertex) {
    parents.push_back(ends_of(edge));
    TriangleKernel::split(edge, vertex);
  }

  Parents ends_of(EdgeHandle edge) const {
    const HalfedgeHandle halfedge = halfedge_handle(edge, 0);
    return {index_of(to_vertex_handle(halfedge)), index_of(from_vertex_handle(halfedge))};
  }

  std::vector<Parents> parents;  // of the vertices that were not there at first

 private:
  void add_triangle(std::size_t face, std::span<const std::uint32_t> corners) {
    const auto refuse = [&](const std::string& what) {
      throw std::invalid_argument(
          fmt::format("OpenMesh's methods of refining take manifolds of triangles, but face {} {}; the own "
                      "method takes it",
                      face, what));
    };
    if (corners.size() != 3) refuse(fmt::format("has {} vertices", corners.size()));
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      refuse("has a vertex twice");
    }
    const auto vertex = [&](std::size_t k) { return VertexHandle(static_cast<int>(corners[k])); };
    if (add_face(vertex(0), vertex(1), vertex(2)).is_valid()) return;
    refuse(
        "meets an edge of two others, disagrees with its neighbour on the outside, or touches others in a "
        "vertex alone");
  }

  const RefineOptions& options_;
};

RefinedMesh finish(const PolygonMesh& mesh, TriangleMesh refined) {
  RefinedMesh result;
  result.mesh.properties = mesh.properties;
  result.mesh.position_type = mesh.position_type;
  for (const auto vertex : refined.vertices()) {
    const auto& p = refined.point(vertex);
    result.mesh.positions.push_back({p[0], p[1], p[2]});
  }
  for (const auto face : refined.faces()) {
    Triangle corners{};
    std::size_t k = 0;
    for (const auto vertex : refined.fv_range(face)) corners[k++] = index_of(vertex);
    result.mesh.add_face(corners);
  }
  result.parents = std::move(refined.parents);
  result.carry_properties();
  return result;
}

// A subdivider of a mesh. The base class of OpenMesh's calls what only they implement when it is made with a
// mesh, or destroyed with one.
template <typename Subdivider>
class Attached : public Subdivider {
 public:
  explicit Attached(TriangleMesh& mesh) { this->attach(mesh); }
  ~Attached() { this->detach(); }
};

RefinedMesh split_longest(const PolygonMesh& mesh, double longest, const RefineOptions& options) {
  TriangleMesh refined(mesh, options);
  Attached<OpenMesh::Subdivider::Uniform::LongestEdgeT<TriangleMesh, double>> subdivider(refined);
  subdivider.set_max_edge_length(longest);
  subdivider(1);
  subdivider.detach();
  return finish(mesh, std::move(refined));
}

// OpenMesh has weights for 50 neighbours unless it is told of more.
template <typename Subdivider>
void prepare_weights(const TriangleMesh& mesh, Subdivider& subdivider) {
  std::size_t most = 0;
  for (const auto vertex : mesh.vertices()) most = std::max<std::size_t>(most, mesh.valence(vertex));
  subdivider.init_weights(most + 50);
}

// Loop's new vertices are those of the edges, in their order.
RefinedMesh make_loop(const PolygonMesh& mesh, int rounds, const RefineOptions& options) {
  TriangleMesh refined(mesh, options);
  Attached<OpenMesh::Subdivider::Uniform::LoopT<TriangleMesh, double>> subdivider(refined);
  prepare_weights(refined, subdivider);
  for (int round = 0; round < rounds; ++round) {
    require_vertices(refined.n_vertices() + refined.n_edges(), options);
    for (const auto edge : refined.edges()) refined.parents.push_back(refined.ends_of(edge));
    subdivider(1);
  }
  subdivider.detach();
  return finish(mesh, std::move(refined));
}

// Those of the square root of three: every other round two of each edge at the boundary, and one of each
// face, but in these rounds not of those at the boundary.
RefinedMesh make_sqrt3(const PolygonMesh& mesh, int rounds, const RefineOptions& options) {
  TriangleMesh refined(mesh, options);
  Attached<OpenMesh::Subdivider::Uniform::Sqrt3T<TriangleMesh, double>> subdivider(refined);
  prepare_weights(refined, subdivider);
  for (int round = 0; round < rounds; ++round) {
    const bool splits_boundary = round % 2 == 1;
    require_vertices(refined.n_vertices() + refined.n_faces() + 2 * refined.n_edges(), options);
    for (const auto edge : refined.edges()) {
      if (!splits_boundary || !refined.is_boundary(edge)) continue;
      // From the outer half-edge: first the vertex next to its end, then that next to its start.
      const auto outer = refined.halfedge_handle(edge, refined.is_boundary(refined.halfedge_handle(edge, 1)));
      const std::uint32_t end = index_of(refined.to_vertex_handle(outer));
      const std::uint32_t start = index_of(refined.from_vertex_handle(outer));
      refined.parents.emplace_back(end, end, start);
      refined.parents.emplace_back(end, start, start);
    }
    for (const auto face : refined.faces()) {
      if (splits_boundary && refined.is_boundary(face)) continue;
      auto corner = refined.fv_iter(face);
      const std::uint32_t a = index_of(*corner);
      const std::uint32_t b = index_of(*++corner);
      const std::uint32_t c = index_of(*++corner);
      refined.parents.emplace_back(a, b, c);
    }
    subdivider(1);
  }
  subdivider.detach();
  return finish(mesh, std::move(refined));
}

// Calls `function` with the ends of each side of each face and the length between them.
template <typename Function>
void for_each_side(const PolygonMesh& mesh, const Function& function) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k];
      const std::uint32_t b = face[(k + 1) % face.size()];
      function(a, b, glm::distance(mesh.positions[a], mesh.positions[b]));
    }
  }
}

}  // namespace

int openmesh_rounds(const PolygonMesh& mesh, const std::vector<double>& targets,
                    RefineOptions::Method method) {
  double excess = 1.0;  // of an edge over its target
  for_each_side(mesh, [&](std::uint32_t a, std::uint32_t b, double length) {
    excess = std::max(excess, length / std::min(targets[a], targets[b]));
  });
  const double by_round = method == Method::loop ? 2.0 : std::sqrt(3.0);
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::ceil(std::log(excess) / std::log(by_round) - kRounding));
}

RefinedMesh refine_by_openmesh(const PolygonMesh& mesh, const std::vector<double>& targets,
                               const RefineOptions& options) {
  if (options.method == Method::longest_edge) {
    const double shortest = targets.empty() ? 1.0 : *std::min_element(targets.begin(), targets.end());
    return split_longest(mesh, shortest, options);
  }
  return subdivide_by_openmesh(mesh, openmesh_rounds(mesh, targets, options.method), options);
}

RefinedMesh subdivide_by_openmesh(const PolygonMesh& mesh, int rounds, const RefineOptions& options) {
  if (options.method == Method::loop) return make_loop(mesh, rounds, options);
  if (options.method == Method::sqrt3) return make_sqrt3(mesh, rounds, options);
  double longest = 0.0;
  for_each_side(mesh,
                [&](std::uint32_t, std::uint32_t, double length) { longest = std::max(longest, length); });
  // A shade longer, so that rounding does not split those that are just as long as asked for.
  constexpr double kShade = 1.0 + 1e-9;
  return split_longest(mesh, longest * kShade * std::exp2(-rounds), options);
}

}  // namespace solidnoise
