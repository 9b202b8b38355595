#include "solidnoise/recipe/noise_recipe_json.h"

#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "solidnoise/noise/gabor/gabor_fields.h"
#include "solidnoise/noise/gradient/gradient_fields.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"

namespace solidnoise {
namespace {

// In the order of the alternatives of NoiseRecipe::noise.
const std::vector<std::string_view> kNoiseTypes{"gabor", "gabor-oriented", "kensler", "spectrum"};

using NoiseVariant = decltype(NoiseRecipe::noise);
static_assert(std::variant_size_v<NoiseVariant> == 4, "kNoiseTypes needs a name for each noise");

template <std::size_t... Is>
NoiseVariant default_alternative(std::size_t index, std::index_sequence<Is...>) {
  NoiseVariant noise;
  ((Is == index ? static_cast<void>(noise.emplace<Is>()) : void()), ...);
  return noise;
}

NoiseVariant default_alternative(std::size_t index) {
  return default_alternative(index, std::make_index_sequence<std::variant_size_v<NoiseVariant>>());
}

}  // namespace

std::string_view noise_type(const NoiseRecipe& recipe) {
  return kNoiseTypes[recipe.noise.index()];
}

NoiseRecipe default_noise(std::string_view type) {
  for (std::size_t i = 0; i < kNoiseTypes.size(); ++i) {
    if (kNoiseTypes[i] == type) return {default_alternative(i), {}};
  }
  throw std::invalid_argument(
      fmt::format("noise is {}; it must be one of {}", type, fmt::join(kNoiseTypes, ", ")));
}

Json to_json(const NoiseRecipe& recipe) {
  Json json = Json::object();
  json["type"] = noise_type(recipe);
  std::visit([&](const auto& options) { write_fields(options, json); }, recipe.noise);
  write_fields(recipe.fractal, json);
  return json;
}

NoiseRecipe noise_recipe_from_json(JsonReader& reader) {
  NoiseRecipe recipe;
  recipe.noise = default_alternative(reader.read_choice("type", kNoiseTypes));
  std::visit([&](auto& options) { read_fields(reader, options); }, recipe.noise);
  read_fields(reader, recipe.fractal);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

}  // namespace solidnoise
