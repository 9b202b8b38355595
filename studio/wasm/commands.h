#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise::studio {

// What the page asks for, and what it gets: an object, and arrays of numbers, which go by themselves.
struct Answer {
  Json json;
  std::vector<std::vector<float>> floats{};
};

// One thing that can be asked. Throws std::invalid_argument and std::runtime_error; what they say is for
// people. `bytes` are those of a file or a picture that goes with the question.
using Command = Answer (*)(const Json& question, std::span<const unsigned char> bytes);
struct NamedCommand {
  std::string_view name;
  Command run;
};

// Recipes: as text in, whole and in order out; what is known of them; controls' table.
Answer describe_fields(const Json&, std::span<const unsigned char>);
Answer check_recipe(const Json&, std::span<const unsigned char>);
Answer edit_recipe(const Json&, std::span<const unsigned char>);

// Pictures of a recipe's noise.
Answer make_slice(const Json&, std::span<const unsigned char>);
Answer make_spectrum(const Json&, std::span<const unsigned char>);
Answer make_volume_values(const Json&, std::span<const unsigned char>);
Answer light_volume(const Json&, std::span<const unsigned char>);

// Surfaces.
Answer load_mesh(const Json&, std::span<const unsigned char>);
Answer bake_mesh(const Json&, std::span<const unsigned char>);

// Noise by example.
Answer fit_example(const Json&, std::span<const unsigned char>);
Answer draw_version(const Json&, std::span<const unsigned char>);
Answer draw_example(const Json&, std::span<const unsigned char>);
Answer edit_example(const Json&, std::span<const unsigned char>);

BakeRecipe read_bake_recipe(const std::string& text);
// A recipe as the page has it. What needs files that a page has not is refused with the command that does it.
VolumeRecipe read_recipe(const std::string& text);
// The same of a question's "recipe", in the short form of the grid that its "grid" names.
VolumeRecipe grid_of_question(const Json& question);

}  // namespace solidnoise::studio
