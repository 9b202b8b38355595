#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "support/paths.h"

namespace solidnoise::example_recipes_test {
namespace {

// Recipes of meshnoise say how a surface is painted.
bool is_of_volume(const Json& json) {
  return !json.contains("surface");
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ExampleRecipes, AreAcceptedAndDescribedInTheirTable) {
  const std::filesystem::path examples = in_source("examples");
  const std::string table = text_of(examples / "README.md");
  int volumes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(examples / "recipes")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".json") continue;
    EXPECT_NE(table.find("recipes/" + name), std::string::npos) << name << " is not in examples/README.md";
    const Json json = parse_json(text_of(entry.path()));
    if (!is_of_volume(json)) continue;
    ++volumes;
    EXPECT_NO_THROW({
      VolumeRecipe recipe = volume_recipe_from_json(json);
      EXPECT_FALSE(recipe.description.empty()) << name;
      if (recipe.modification) recipe.modification->on.file = "some.vdb";
      recipe.validate();
    }) << name;
  }
  EXPECT_GE(volumes, 13);
}

}  // namespace
}  // namespace solidnoise::example_recipes_test
