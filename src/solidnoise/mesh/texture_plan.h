#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/mesh/bake_mesh.h"

namespace solidnoise {

struct TextureOptions {
  int size = 2048;   // texels along each side of a texture; 1 to 32768
  int padding = 16;  // texels that islands are continued by; 0 to 1024
};

// Which textures there may be: the one square of coordinates from 0 to 1, or UDIM's, ten to a row, of which
// 1001 is that square, 1002 the one to its right and 1011 the one above it.
enum class TextureTiles { one, udim };
inline constexpr int kFirstUdim = 1001;
inline constexpr int kUdimColumns = 10;
inline constexpr int kMostUdimRows = 10;

// A triangle of the mesh in the plane of textures.
struct TextureTriangle {
  std::array<std::uint32_t, 3> vertices;  // of the plan's mesh
  std::array<Vec<2>, 3> places;           // texture coordinates, v upwards
  // Along u, at each corner: the mean of the triangles that share the vertex and the place there, by their
  // angles, and whether v turns left from u as seen from outside, as MikkTSpace has them.
  std::array<Vec<3>, 3> tangents;
  bool mirrored = false;
};

struct TextureTile {
  int udim = kFirstUdim;
  std::vector<std::uint32_t> triangles;  // that reach into it
};

// A mesh that is ready for its noise to be baked into textures.
//
// A texel stands for a Gaussian around its place on the surface, whose standard deviation is kBandLimit of a
// voxel for volumes, and here half of the texel's length there, the longer one: it is a number that points of
// the surface have (the mean over the triangles around), so that texels of two islands agree where these
// meet.
struct TexturePlan {
  BakePlan bake;
  TextureOptions options;
  std::vector<TextureTriangle> triangles;  // those that have an area, in the plane of textures and in space
  std::vector<TextureTile> tiles;          // in order
  std::vector<float> deviations;           // of vertices, world units
  std::size_t without_area = 0;            // triangles, in the plane of textures
  double texels = 0.0;                     // that triangles cover

  Vec<2> corner_of(const TextureTile& tile) const;
  double most_deviation() const;
};

// `corners`: where each corner of the plan's faces is in textures. Throws std::invalid_argument naming the
// face whose coordinates are outside of the tiles that there may be, and for a mesh whose faces have no area
// there; options that are out of range.
TexturePlan plan_textures(BakePlan plan, std::span<const Vec<2>> corners, TextureTiles tiles,
                          const TextureOptions& options);

// A texel that triangles cover or reach by a texel and a half, and the nearest of them.
struct Texel {
  std::uint32_t index = 0;  // row by row from the top
  std::uint32_t triangle = 0;
};

struct TileTexels {
  std::vector<Texel> texels;   // in order
  std::size_t overlapped = 0;  // that several triangles cover; the first has them
};

// The texels of a tile. In parallel.
TileTexels find_texels(const TexturePlan& plan, const TextureTile& tile);

// The weights of its triangle's vertices at a texel: their sum is 1, beyond an edge one is below 0.
Vec<3> weights_at(const TexturePlan& plan, const TextureTile& tile, const Texel& texel);

}  // namespace solidnoise
