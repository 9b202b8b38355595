#include "vdbnoise/recipe_source.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/text_file.h"
#include "solidnoise/recipe/recipe_header.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/vdb_read.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/presets.h"

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
  try {
    const Json json = parse_json(text);
    LoadedRecipe loaded{volume_recipe_from_json(json), {}};
    const int algorithm = algorithm_of(json);
    if (algorithm != kAlgorithmVersion) {
      loaded.warning = fmt::format(
          "{}: made by version {} of the algorithms, this is version {}; the values will not be the same",
          path.string(), algorithm, kAlgorithmVersion);
    }
    return loaded;
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

VolumeRecipe load_preset(const std::string& name) {
  return volume_recipe_from_json(parse_json(find_preset(name).json));
}

}  // namespace solidnoise
