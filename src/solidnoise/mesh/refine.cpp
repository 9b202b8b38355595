#include "solidnoise/mesh/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "solidnoise/core/check.h"
#include "solidnoise/geometry/scalar_type.h"
#include "solidnoise/mesh/cut_triangle.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/mesh/tangent_frames.h"

namespace solidnoise {
namespace {

// A triangle and the polygon that it is a part of.
struct Piece {
  Triangle corners;
  std::uint32_t face;
};

void require_faces(double count, const RefineOptions& options) {
  if (count <= static_cast<double>(options.most_faces)) return;
  throw std::invalid_argument(fmt::format(
      "refining takes more than {} faces, the most that there is room for: refine less", options.most_faces));
}

class Refiner {
 public:
  Refiner(const PolygonMesh& mesh, std::vector<double> targets, const RefineOptions& options,
          Progress* progress)
      : mesh_(mesh), options_(options), progress_(progress), targets_(std::move(targets)), result_(mesh) {
    require_at_least("most_vertices", static_cast<double>(options.most_vertices), 1.0);
    const SurfaceMesh surface(mesh);
    normals_ = surface.to_vertices(surface.normals());
    // Both sides of a seam must come to the same decisions and the same new vertices.
    result_.positions = surface.to_vertices(surface.positions());
    std::vector<double> at_points(surface.point_count(), std::numeric_limits<double>::infinity());
    for (std::size_t v = 0; v < targets_.size(); ++v) {
      double& smallest = at_points[surface.point_of(v)];
      smallest = std::min(smallest, targets_[v]);
    }
    targets_ = surface.to_vertices(at_points);
  }

  RefinedMesh split_long_edges() {
    const auto too_long = [this](std::uint32_t a, std::uint32_t b) {
      return glm::distance(result_.positions[a], result_.positions[b]) > std::min(targets_[a], targets_[b]);
    };
    cut_polygons(too_long);
    while (split(too_long)) {
    }
    return assemble();
  }

  RefinedMesh halve_edges(int rounds) {
    const auto every = [](std::uint32_t, std::uint32_t) { return true; };
    if (rounds > 0) cut_polygons(every);
    for (int round = 0; round < rounds; ++round) split(every);
    return assemble();
  }

 private:
  // Takes the polygons that have something to split as triangles; the others are never touched again.
  template <typename Predicate>
  void cut_polygons(const Predicate& to_split) {
    is_cut_.assign(mesh_.face_count(), 0);
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const auto face = mesh_.face(f);
      const std::size_t first = pieces_.size();
      for (std::size_t i = 2; i < face.size(); ++i) {
        pieces_.push_back({{face[0], face[i - 1], face[i]}, static_cast<std::uint32_t>(f)});
        for (std::size_t k = 0; k < 3; ++k) {
          const Triangle& corners = pieces_.back().corners;
          if (to_split(corners[k], corners[(k + 1) % 3])) is_cut_[f] = 1;
        }
      }
      if (is_cut_[f] == 0) pieces_.resize(first);
    }
  }

  // One round. Returns whether there was an edge to split.
  template <typename Predicate>
  bool split(const Predicate& to_split) {
    throw_if_cancelled(progress_);
    // The edges to split, by their vertices, from each triangle that has them.
    struct Edge {
      std::uint64_t vertices;  // the smaller one in the upper half
      std::uint32_t piece;
      std::uint32_t corner;
    };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = pieces_[i].corners[k];
        const std::uint32_t b = pieces_[i].corners[(k + 1) % 3];
        if (a == b || !to_split(a, b)) continue;
        const std::uint64_t vertices = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        edges.push_back({vertices, static_cast<std::uint32_t>(i), k});
      }
    }
    if (edges.empty()) return false;
    require_faces(static_cast<double>(pieces_.size() + edges.size()), options_);
    tbb::parallel_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.vertices, a.piece, a.corner) < std::tie(b.vertices, b.piece, b.corner);
    });
    // A new vertex for each of them.
    std::vector<std::array<std::uint32_t, 3>> middles(pieces_.size(), {kWhole, kWhole, kWhole});
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (i == 0 || edges[i].vertices != edges[i - 1].vertices) {
        ends.push_back({static_cast<std::uint32_t>(edges[i].vertices >> 32),
                        static_cast<std::uint32_t>(edges[i].vertices)});
      }
      middles[edges[i].piece][edges[i].corner] =
          static_cast<std::uint32_t>(result_.positions.size() + ends.size() - 1);
    }
    add_vertices(ends);
    cut_pieces(middles);
    return true;
  }

  void add_vertices(const std::vector<std::array<std::uint32_t, 2>>& ends) {
    const std::size_t old = result_.positions.size();
    require_vertices(old + ends.size(), options_);
    const std::size_t count = old + ends.size();
    result_.positions.resize(count);
    normals_.resize(count);
    targets_.resize(count);
    tbb::parallel_for(std::size_t{0}, ends.size(), [&](std::size_t i) {
      const auto [a, b] = ends[i];
      result_.positions[old + i] = middle_of(a, b);
      const Vec<3> normal = normals_[a] + normals_[b];
      const double length = glm::length(normal);
      normals_[old + i] = length > 0.0 ? normal / length : normals_[a];
      targets_[old + i] = 0.5 * (targets_[a] + targets_[b]);
    });
    for (const auto& [a, b] : ends) parents_.emplace_back(a, b);
  }

  Vec<3> middle_of(std::uint32_t a, std::uint32_t b) const {
    const Vec<3>& p = result_.positions[a];
    const Vec<3>& q = result_.positions[b];
    const Vec<3> middle = 0.5 * (p + q);
    if (options_.placement == RefineOptions::Placement::on_edges) return middle;
    const Vec<3> bend =
        glm::dot(q - p, normals_[a]) * normals_[a] + glm::dot(p - q, normals_[b]) * normals_[b];
    return middle - 0.125 * bend;
  }

  // Replaces each triangle by its parts, in its place.
  void cut_pieces(const std::vector<std::array<std::uint32_t, 3>>& middles) {
    std::vector<std::size_t> starts(pieces_.size() + 1);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      starts[i + 1] =
          starts[i] + 1 + (middles[i][0] != kWhole) + (middles[i][1] != kWhole) + (middles[i][2] != kWhole);
    }
    std::vector<Piece> parts(starts.back());
    const auto place = [this](std::uint32_t vertex) -> const Vec<3>& { return result_.positions[vertex]; };
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t i) {
      Piece* part = &parts[starts[i]];
      for (const Triangle& corners : cut_triangle(pieces_[i].corners, middles[i], place)) {
        if (part == parts.data() + starts[i + 1]) break;
        *part++ = {corners, pieces_[i].face};
      }
    });
    pieces_ = std::move(parts);
  }

  RefinedMesh assemble() {
    std::copy(mesh_.positions.begin(), mesh_.positions.end(), result_.positions.begin());
    result_.face_starts.assign(1, 0);
    result_.corners.clear();
    auto piece = pieces_.begin();
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      if (is_cut_.empty() || is_cut_[f] == 0) result_.add_face(mesh_.face(f));
      for (; piece != pieces_.end() && piece->face == f; ++piece) result_.add_face(piece->corners);
    }
    RefinedMesh refined{std::move(result_), std::move(parents_)};
    refined.carry_properties();
    return refined;
  }

  const PolygonMesh& mesh_;
  const RefineOptions& options_;
  Progress* progress_;
  std::vector<double> targets_;  // of the result's vertices
  std::vector<Vec<3>> normals_;  // of the result's vertices, the surface's
  PolygonMesh
      result_;  // until assemble() its faces are the mesh's, and their vertices at the surface's points
  std::vector<Parents> parents_;  // of the new vertices
  std::vector<char> is_cut_;      // of the mesh's faces
  std::vector<Piece> pieces_;     // of those that are cut, in their order
};

// One for each vertex. Throws std::invalid_argument.
std::vector<double> targets_of(const PolygonMesh& mesh, std::span<const double> target) {
  const std::size_t vertices = mesh.positions.size();
  if (target.size() != 1 && target.size() != vertices) {
    throw std::invalid_argument(
        fmt::format("there are {} lengths of edges for {} vertices", target.size(), vertices));
  }
  for (std::size_t v = 0; v < target.size(); ++v) {
    require_positive(target.size() == 1 ? std::string("the length of edges")
                                        : fmt::format("the length of edges at vertex {}", v),
                     target[v], "world units");
  }
  if (target.size() == 1) return std::vector<double>(vertices, target[0]);
  return {target.begin(), target.end()};
}

// The parts of the normals that a file has, if it has all three as floats.
std::array<VertexProperty*, 3> find_normals(PolygonMesh& mesh) {
  std::array<VertexProperty*, 3> parts{};
  for (VertexProperty& property : mesh.properties) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (property.name == kNormalNames[axis] && is_float(property.type)) parts[axis] = &property;
    }
  }
  if (parts[0] == nullptr || parts[1] == nullptr || parts[2] == nullptr) return {};
  return parts;
}

}  // namespace

std::vector<float> RefinedMesh::carry(std::vector<float> numbers) const {
  numbers.reserve(numbers.size() + parents.size());
  for (const Parents& of_vertex : parents) numbers.push_back(of_vertex.mean(numbers));
  return numbers;
}

void RefinedMesh::carry_properties() {
  const std::array<VertexProperty*, 3> normals = find_normals(mesh);
  for (const Parents& of_vertex : parents) {
    for (VertexProperty& property : mesh.properties) {
      const double mean = of_vertex.mean(property.values);
      property.values.push_back(is_float(property.type) ? mean : std::round(mean));
    }
    if (normals[0] == nullptr) continue;
    const double length =
        std::hypot(normals[0]->values.back(), normals[1]->values.back(), normals[2]->values.back());
    if (!(length > 0.0)) continue;
    for (VertexProperty* const part : normals) part->values.back() /= length;
  }
}

std::vector<Vec<3>> RefinedMesh::carry_lines(std::vector<Vec<3>> directions) const {
  directions.reserve(directions.size() + parents.size());
  for (const Parents& of_vertex : parents) {
    LineMean mean;
    for (const std::uint32_t vertex : of_vertex.vertices()) mean.add(directions[vertex], 1.0);
    directions.push_back(mean.line());
  }
  return directions;
}

void require_vertices(std::size_t count, const RefineOptions& options) {
  if (count <= options.most_vertices) return;
  throw std::invalid_argument(
      fmt::format("refining takes more than {} vertices, the most that there is room for: refine less",
                  options.most_vertices));
}

RefinedMesh refine(const PolygonMesh& mesh, std::span<const double> target, const RefineOptions& options,
                   Progress* progress) {
  std::vector<double> targets = targets_of(mesh, target);
  require_faces(refined_faces(mesh, targets, options, static_cast<double>(options.most_faces)), options);
  if (options.method != RefineOptions::Method::own) return refine_by_openmesh(mesh, targets, options);
  return Refiner(mesh, std::move(targets), options, progress).split_long_edges();
}

double refined_vertices(const PolygonMesh& mesh, std::span<const double> target, const RefineOptions& options,
                        double most) {
  // On a closed surface a vertex more is two faces more.
  const double vertices = static_cast<double>(mesh.positions.size());
  const double faces = static_cast<double>(triangulate(mesh).size());
  const double most_faces = faces + 2.0 * std::max(most - vertices, 0.0);
  return vertices + 0.5 * (refined_faces(mesh, targets_of(mesh, target), options, most_faces) - faces);
}

RefinedMesh subdivide(const PolygonMesh& mesh, int rounds, const RefineOptions& options, Progress* progress) {
  require_in_range("the rounds of refining", rounds, 0, 16);
  if (options.method != RefineOptions::Method::longest_edge) {
    const double parts = options.method == RefineOptions::Method::sqrt3 ? 3.0 : 4.0;
    require_faces(static_cast<double>(triangulate(mesh).size()) * std::pow(parts, rounds), options);
  }
  if (options.method != RefineOptions::Method::own) return subdivide_by_openmesh(mesh, rounds, options);
  return Refiner(mesh, std::vector<double>(mesh.positions.size(), 1.0), options, progress)
      .halve_edges(rounds);
}

}  // namespace solidnoise
