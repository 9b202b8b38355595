#include "solidnoise/volume/slice/slice_field.h"

#include <algorithm>
#include <stdexcept>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/check.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/volume/recipe_field.h"
#include "solidnoise/volume/shape_field.h"
#include "solidnoise/volume/slice/grid_slice.h"
#include "solidnoise/volume/slice/noise_slice.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

// The place of the grid's output among those of its short form.
std::size_t sliced_output(const SliceRecipe& slice, const VolumeRecipe& grid) {
  const std::vector<std::string> names = grid_names(grid);
  const auto found = std::ranges::find(names, slice.grid);
  return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin());
}

bool has_components(Output output) {
  return output == Output::gradient || output == Output::curl;
}

SliceField make_noise_field(const SliceRecipe& slice, const VolumeRecipe& grid) {
  VolumeRecipe recipe = at_resolution(grid, Vec<3>(slice.plane.pixel));
  recipe.exact = recipe.exact || slice.line;
  recipe.output = {Output::value};
  const bool color = slice.color || grid.output == std::vector{Output::color};
  SliceField field;
  std::vector<SliceSourcePtr> channels;
  for (int channel = 0; channel < (color ? 3 : 1); ++channel) {
    VolumeRecipe single = recipe;
    if (color) single.noise = channel_of(recipe.noise, channel);
    const NoiseSlice noise =
        recipe.dims < 3 ? make_flat_slice(single, slice.plane) : make_noise_slice(single, slice.plane);
    channels.push_back(noise.source);
    field.sigma = noise.sigma;
    field.variances.push_back(variance_of(recipe, noise));
    field.shown = noise.shown;
  }
  if (const ExemplarModel* const exemplar = exemplar_of_colors(recipe); exemplar && color) {
    field.exemplar = *exemplar;
  }
  field.highest_frequency = highest_frequency_in_slice(recipe);
  field.source = side_by_side(std::move(channels));
  return field;
}

SliceField make_recipe_field(const SliceRecipe& slice, const VolumeRecipe& grid, Progress* progress) {
  require_at_least("the side of a pixel", slice.plane.pixel, GridFrame::kLeastVoxel, "world units");
  const RecipeField field(slice.recipe, slice.grid, progress);
  const GridFrame pixels(slice.plane.pixel);
  VolumeField values = field.on_voxels(pixels);
  if (is_bounded(slice)) values.field = masked(values.field, shape_at_points(grid, slice.plane.pixel));
  const GridChannels& sliced = values.grids[sliced_output(slice, grid)];
  SliceField result;
  result.source = make_slice_source(values.field, {sliced.first, sliced.count, slice.component});
  result.highest_frequency = field.highest_frequency(pixels);
  if (has_density(grid)) result.shown = {0.0, 1.0};
  return result;
}

}  // namespace

VolumeRecipe sliced_grid(const SliceRecipe& slice) {
  if (!slice.grid.empty()) require_grid(slice.recipe, slice.grid);
  return recipe_of_grid(slice.recipe, slice.grid);
}

bool is_bounded(const SliceRecipe& slice) {
  return has_density(slice.recipe) || !std::holds_alternative<BoxShape>(slice.recipe.shape);
}

void require_sliceable(const SliceRecipe& slice) {
  const VolumeRecipe grid = sliced_grid(slice);
  if (grid.modification) {
    throw std::invalid_argument("the recipe works on a grid that exists; slice the volume that it makes");
  }
  if (std::holds_alternative<MeshShape>(grid.shape) || std::holds_alternative<GridShape>(grid.shape)) {
    throw std::invalid_argument("the recipe's shape is that of a file; slice the volume that it makes");
  }
  const Output output = grid.output[sliced_output(slice, grid)];
  if (slice.component && !has_components(output)) {
    throw std::invalid_argument(
        fmt::format("component is of vectors; {} has none", grid_names(grid).front()));
  }
  if (is_noise_alone(grid)) return;
  if (slice.color) throw std::invalid_argument("color is of a noise alone, without layers and shapings");
  if (grid.dims < 3) {
    throw std::invalid_argument(fmt::format(
        "dims is {}; it must be 3 or 4 but for a noise alone, without layers and shapings", grid.dims));
  }
}

SliceField make_slice_field(const SliceRecipe& slice, Progress* progress) {
  if (!slice.file.empty()) return make_grid_slice(slice, progress);
  require_sliceable(slice);
  const VolumeRecipe grid = sliced_grid(slice);
  return is_noise_alone(grid) ? make_noise_field(slice, grid) : make_recipe_field(slice, grid, progress);
}

}  // namespace solidnoise
