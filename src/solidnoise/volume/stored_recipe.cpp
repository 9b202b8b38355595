#include "solidnoise/volume/stored_recipe.h"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/named_error.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {

std::optional<VolumeRecipe> stored_recipe(const openvdb::GridBase& grid, const std::string& file) {
  const auto metadata = grid.getMetadata<openvdb::StringMetadata>(kRecipeKey);
  if (!metadata) return std::nullopt;
  return in_file(file, [&] { return volume_recipe_from_json(parse_json(metadata->value())); });
}

std::string recipe_text_in(const std::filesystem::path& path) {
  for (const GridSummary& summary : read_vdb_summary(path).grids) {
    const auto found = summary.metadata.find(kRecipeKey);
    if (found != summary.metadata.end()) return found->second;
  }
  throw std::runtime_error(fmt::format("{}: none of its grids carries a recipe of vdbnoise", path.string()));
}

}  // namespace solidnoise
