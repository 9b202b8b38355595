#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/noise_recipe_json.h"

// Whatever can be read as the recipe of a noise, or as a file of noisefit, can be written and read again, and
// what it makes of a block of 8^3 samples are finite numbers.

namespace solidnoise {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

NoiseRecipe recipe_in(const Json& json) {
  if (json.is_object() && json.contains("exemplar")) {
    SpectrumNoiseOptions options;
    options.model = exemplar_file_from_json(json);
    require(exemplar_file_from_json(exemplar_file_to_json(options.model)) == options.model);
    return {options, {}};
  }
  JsonReader reader(json);
  const NoiseRecipe recipe = noise_recipe_from_json(reader);
  reader.finish();
  const Json again = to_json(recipe);
  JsonReader second(again);
  require(noise_recipe_from_json(second) == recipe);
  return recipe;
}

void evaluate(const NoiseRecipe& recipe) {
  const auto noise = make_noise<3>(recipe);
  Lattice<3> lattice;
  lattice.step = Vec<3>(0.125);
  lattice.count = glm::ivec3(8);
  std::vector<float> values(lattice.size());
  noise->evaluate(lattice, {.values = values});
  for (const float value : values) require(value - value == 0.0f);
}

}  // namespace
}  // namespace solidnoise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidnoise;
  try {
    evaluate(recipe_in(parse_json({reinterpret_cast<const char*>(data), size})));
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
