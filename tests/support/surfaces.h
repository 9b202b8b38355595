#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "solidnoise/core/random.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/geometry/polygon_mesh.h"

// Meshes of known surfaces, for tests. All triangles are counter-clockwise from outside (from above for
// patches). Vertices lie on the surface to the last bits.
namespace solidnoise {

// How a surface is cut up: from a grid of squares, each vertex moved along the surface.
struct Tessellation {
  int n = 16;              // squares along the shorter side of the surface's grid
  double jitter = 0.0;     // how far vertices move at most, in squares along each axis; 0.35 is irregular
  std::uint64_t seed = 1;  // of the movements, and of the diagonals, which are at random if there is jitter
};

namespace detail {

inline double uniform(std::uint64_t key, std::uint64_t index, double low, double high) {
  return low + (high - low) * RandomStream(derive_seed(key, index)).next_unit();
}

// Adds the square a b c d as two triangles.
inline void add_square(PolygonMesh& mesh, const std::array<std::uint32_t, 4>& square,
                       const Tessellation& tessellation) {
  const auto key = static_cast<std::uint64_t>(mesh.face_count());
  const bool turn =
      tessellation.jitter > 0.0 && uniform(derive_seed(tessellation.seed, 7), key, 0.0, 1.0) < 0.5;
  const auto [a, b, c, d] = square;
  mesh.add_face(turn ? Triangle{b, c, d} : Triangle{a, b, c});
  mesh.add_face(turn ? Triangle{b, d, a} : Triangle{a, c, d});
}

}  // namespace detail

// Whether the ends of a grid's axis are one.
enum class Ends { open, joined };

// The image of the unit square under `surface`(u, v), from columns x rows squares; the normal is du x dv.
// Vertices on an open side stay on it.
template <typename Surface>
PolygonMesh grid_mesh(int columns, int rows, std::array<Ends, 2> ends, const Tessellation& tessellation,
                      const Surface& surface) {
  PolygonMesh mesh;
  const int stored_columns = columns + (ends[0] == Ends::open ? 1 : 0);
  const int stored_rows = rows + (ends[1] == Ends::open ? 1 : 0);
  for (int j = 0; j < stored_rows; ++j) {
    for (int i = 0; i < stored_columns; ++i) {
      const auto key = 2 * static_cast<std::uint64_t>(mesh.positions.size());
      const auto move = [&](int axis, int at, int last) {
        if (ends[static_cast<std::size_t>(axis)] == Ends::open && (at == 0 || at == last)) return 0.0;
        return detail::uniform(tessellation.seed, key + static_cast<std::uint64_t>(axis),
                               -tessellation.jitter, tessellation.jitter);
      };
      mesh.positions.push_back(surface((i + move(0, i, columns)) / columns, (j + move(1, j, rows)) / rows));
    }
  }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>((j % stored_rows) * stored_columns + i % stored_columns);
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      detail::add_square(mesh, {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)},
                         tessellation);
    }
  }
  return mesh;
}

// The ellipsoid of these half axes around the origin: the sides of a cube, n squares along each edge, on the
// sphere and then stretched.
inline PolygonMesh ellipsoid_mesh(const Vec<3>& half_axes, const Tessellation& tessellation) {
  PolygonMesh mesh;
  const int n = tessellation.n;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto [found, is_new] = known.try_emplace(lattice, static_cast<std::uint32_t>(known.size()));
    if (is_new) {
      Vec<3> p(0.0);
      const auto key = 3 * static_cast<std::uint64_t>(found->second);
      for (int axis = 0; axis < 3; ++axis) {
        const int at = lattice[static_cast<std::size_t>(axis)];
        const double moved = at == 0 || at == n
                                 ? 0.0
                                 : detail::uniform(tessellation.seed, key + static_cast<std::uint64_t>(axis),
                                                   -tessellation.jitter, tessellation.jitter);
        // Equal angles in place of equal lengths, so that squares have nearly equal sizes on the sphere.
        p[axis] = std::tan(0.25 * std::numbers::pi * (2.0 * (at + moved) / n - 1.0));
      }
      mesh.positions.push_back(half_axes * glm::normalize(p));
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      const auto at = [&](int u, int v) {
        std::array<int, 3> lattice{};
        lattice[static_cast<std::size_t>(axis)] = side;
        lattice[static_cast<std::size_t>((axis + 1) % 3)] = side == n ? u : v;
        lattice[static_cast<std::size_t>((axis + 2) % 3)] = side == n ? v : u;
        return vertex(lattice);
      };
      for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) {
          detail::add_square(mesh, {at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)}, tessellation);
        }
      }
    }
  }
  return mesh;
}

inline PolygonMesh sphere_mesh(double radius, const Tessellation& tessellation) {
  return ellipsoid_mesh(Vec<3>(radius), tessellation);
}

// Around the y axis, open at y = 0 and y = height, n squares along the height.
inline PolygonMesh cylinder_mesh(double radius, double height, const Tessellation& tessellation) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const int around = static_cast<int>(std::lround(tessellation.n * kTurn * radius / height));
  return grid_mesh(around, tessellation.n, {Ends::joined, Ends::open}, tessellation, [&](double u, double v) {
    return Vec<3>(radius * std::cos(-kTurn * u), height * v, radius * std::sin(-kTurn * u));
  });
}

// Around the y axis: a tube of radius `minor` along a circle of radius `major`, n squares around the tube.
inline PolygonMesh torus_mesh(double major, double minor, const Tessellation& tessellation) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const int along = static_cast<int>(std::lround(tessellation.n * major / minor));
  return grid_mesh(along, tessellation.n, {Ends::joined, Ends::joined}, tessellation,
                   [&](double u, double v) {
                     const double from_axis = major + minor * std::cos(kTurn * v);
                     return Vec<3>(from_axis * std::cos(-kTurn * u), minor * std::sin(kTurn * v),
                                   from_axis * std::sin(-kTurn * u));
                   });
}

// A sphere around the origin whose corners of a texture's picture have vertices of their own: the first
// meridian is there twice, a pole once for each of its squares, of which there are n from pole to pole and 2
// n around. Angles are in single precision, as renderers have them: the sine of a whole turn is 1.7e-7, and
// the vertices at one place are apart by as much.
inline PolygonMesh seamed_sphere_mesh(double radius, int n) {
  constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
  return grid_mesh(2 * n, n, {Ends::open, Ends::open}, {.n = n}, [&](double u, double v) {
    const float around = kTurn * static_cast<float>(u);
    const float down = 0.5f * kTurn * static_cast<float>(v);
    return radius *
           Vec<3>(std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around));
  });
}

// The same vertices and faces, with each vertex at the place of the first one of equal multiples of 1e-5.
inline PolygonMesh with_closed_seams(PolygonMesh mesh) {
  std::map<std::array<long, 3>, Vec<3>> places;
  for (Vec<3>& p : mesh.positions) {
    const auto cell = [](double x) { return std::lround(1e5 * x); };
    p = places.try_emplace({cell(p.x), cell(p.y), cell(p.z)}, p).first->second;
  }
  return mesh;
}

// The graph z = height(x, y) over the square -half <= x, y <= half, seen from +z.
template <typename Height>
PolygonMesh graph_mesh(double half, const Tessellation& tessellation, const Height& height) {
  return grid_mesh(tessellation.n, tessellation.n, {Ends::open, Ends::open}, tessellation,
                   [&](double u, double v) {
                     const double x = half * (2.0 * u - 1.0);
                     const double y = half * (2.0 * v - 1.0);
                     return Vec<3>(x, y, height(x, y));
                   });
}

// The same surface turned inside out.
inline PolygonMesh flipped(PolygonMesh mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t i = mesh.face_starts[f], j = mesh.face_starts[f + 1]; i + 1 < j; ++i) {
      std::swap(mesh.corners[i], mesh.corners[--j]);
    }
  }
  return mesh;
}

// The same surface with vertices of its own for each face; vertex k is the old mesh's corner k.
inline PolygonMesh split_at_every_edge(const PolygonMesh& mesh) {
  PolygonMesh split;
  split.face_starts = mesh.face_starts;
  for (const std::uint32_t corner : mesh.corners) {
    split.corners.push_back(static_cast<std::uint32_t>(split.positions.size()));
    split.positions.push_back(mesh.positions[corner]);
  }
  return split;
}

// Moves each vertex by a vector uniform in a cube of side 2 `size`: noise of standard deviation
// size / sqrt(3) along any axis.
inline PolygonMesh shaken(PolygonMesh mesh, double size, std::uint64_t seed = 5) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    RandomStream stream(derive_seed(seed, v));
    for (int axis = 0; axis < 3; ++axis) {
      mesh.positions[v][axis] += size * (2.0 * stream.next_unit() - 1.0);
    }
  }
  return mesh;
}

}  // namespace solidnoise
