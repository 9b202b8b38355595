#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solidnoise/core/image.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/texture_plan.h"

namespace solidnoise {

// What a texture shows.
struct TextureMap {
  enum class Kind {
    color,   // three channels, linear light
    normal,  // three: of the surface that the height makes, in the frame of the texture coordinates, 0.5 +
             // 0.5 n
    number,  // one: the noise (times magnitude plus bias), or a property of the recipe
  };

  std::string name;
  Kind kind = Kind::color;
  std::string property{};  // of a number; empty: the noise
};

// One of a recipe, by name: color, normal, height (the property of this name, else the noise), noise, and its
// properties. Throws std::invalid_argument for another name.
TextureMap texture_map(std::string_view name, const BakeRecipe& recipe);

// How far a height of 1 moves the surface in normal maps, world units: as the recipe displaces it, or, where
// it does not, by a tenth of a feature.
double height_of_normals(const BakePlan& plan, const BakeRecipe& recipe);

struct BakedTile {
  std::vector<Image> images;   // of each map; where no face is, and beyond the padding, 0
  std::size_t covered = 0;     // texels
  std::size_t overlapped = 0;  // TileTexels::overlapped
};

// Bakes a tile's textures, in parallel. Each texel is evaluated at its place on the surface, those up to a
// texel and a half beyond an edge on the plane of the nearest triangle, so that interpolating between texels
// continues the noise to the edge; further out, as far as the padding goes, texels are the means of their
// neighbours.
//
// What a texel stands for (TexturePlan) is filtered out of the noise in closed form (BakeVertices::filter).
// Where that differs from place to place the noise is made for some deviations, each 1.22 times the one
// before, and those before and after a texel's are mixed so that the variance of the filter is the texel's,
// exactly. A kernel of its own for each texel would do for noises of the tangent plane; this does for all,
// and for all layers at once.
//
// Throws Cancelled.
BakedTile bake_tile(const TexturePlan& plan, const BakeRecipe& recipe, const std::vector<TextureMap>& maps,
                    const TextureTile& tile, Progress* progress = nullptr);

// Deviations of filters, increasing, in whose place others are mixed.
class FilterLevels {
 public:
  // From the least to the greatest; 0 <= least <= greatest.
  FilterLevels(double least, double greatest);

  // A filter: 1 - share of deviation `level`, share of the next.
  struct Place {
    std::size_t level = 0;
    double share = 0.0;
  };
  Place at(double deviation) const;
  const std::vector<double>& deviations() const { return deviations_; }

 private:
  std::vector<double> deviations_;
};

// Bytes that baking a tile takes at most, beside the mesh, and seconds of one core for all tiles (Cost).
double texture_memory(const TexturePlan& plan, const std::vector<TextureMap>& maps);
double texture_seconds(const TexturePlan& plan, const BakeRecipe& recipe,
                       const std::vector<TextureMap>& maps);

// Cycles per texel of the noise's highest frequency where texels are longest: above 0.5 it aliases, unless it
// is filtered.
double cycles_per_texel(const TexturePlan& plan);
// Whether texels filter all noises of a recipe.
bool filters_all(const BakeRecipe& recipe);

}  // namespace solidnoise
