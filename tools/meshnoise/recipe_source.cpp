#include "meshnoise/recipe_source.h"

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/recipe_files.h"
#include "meshnoise/commands.h"
#include "solidnoise/geometry/read_points.h"
#include "solidnoise/mesh/bake_recipe_json.h"

namespace solidnoise {
namespace {

constexpr std::string_view kRecipeMark = "solidnoise recipe ";

std::string text_of(const std::filesystem::path& path) {
  if (auto text = recipe_in_comments(read_mesh(path, Faces::optional).comments)) return *text;
  throw std::runtime_error(fmt::format("{}: it carries no recipe of meshnoise", path.string()));
}

}  // namespace

BakeRecipe choose_bake_recipe(const FlagSet& flags) {
  BakeRecipe recipe;
  const char* const standard = flags.given("--noise") ? "raw" : "rust";
  load_recipe(flags, {standard, text_of}, [&](const Json& json) { recipe = bake_recipe_from_json(json); });
  return recipe;
}

std::vector<std::string> recipe_comments(const BakeRecipe& recipe) {
  return {kMeshnoise, std::string(kRecipeMark) + to_json(recipe).dump()};
}

std::optional<std::string> recipe_in_comments(const std::vector<std::string>& comments) {
  for (const std::string& comment : comments) {
    const std::size_t mark = comment.find(kRecipeMark);
    if (mark != std::string::npos) return comment.substr(mark + kRecipeMark.size());
  }
  return std::nullopt;
}

}  // namespace solidnoise
