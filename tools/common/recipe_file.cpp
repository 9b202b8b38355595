#include "common/recipe_file.h"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/noise/noise_recipe.h"
#include "solidnoise/recipe/recipe_header.h"

namespace solidnoise {

std::string read_recipe(const std::filesystem::path& path, std::string_view text,
                        const std::function<void(const Json&)>& use) {
  try {
    const Json json = parse_json(text);
    use(json);
    const int algorithm = algorithm_of(json);
    if (algorithm == kAlgorithmVersion) return {};
    return fmt::format(
        "{}: made by version {} of the algorithms, this is version {}; the values will not be the same",
        path.string(), algorithm, kAlgorithmVersion);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", path.string(), with_line(text, error.what())));
  }
}

}  // namespace solidnoise
