#include "vdbnoise/recipe_source.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/presets.h"
#include "common/recipe_file.h"
#include "common/text_file.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

std::string stored_recipe(const std::filesystem::path& path) {
  for (const GridSummary& summary : read_vdb_summary(path).grids) {
    const auto found = summary.metadata.find(kRecipeKey);
    if (found != summary.metadata.end()) return found->second;
  }
  throw std::runtime_error(fmt::format("{}: none of its grids carries a recipe of vdbnoise", path.string()));
}

}  // namespace

LoadedRecipe load_recipe(const std::filesystem::path& path) {
  const std::string text = path.extension() == ".vdb" ? stored_recipe(path) : read_text_file(path);
  LoadedRecipe loaded;
  loaded.warning =
      read_recipe(path, text, [&](const Json& json) { loaded.recipe = volume_recipe_from_json(json); });
  return loaded;
}

VolumeRecipe load_preset(const std::string& name) {
  return volume_recipe_from_json(parse_json(find_preset(name).json));
}

}  // namespace solidnoise
