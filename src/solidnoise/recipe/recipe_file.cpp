#include "solidnoise/recipe/recipe_file.h"

#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/input_file.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {

std::string read_text_file(const std::filesystem::path& path) {
  constexpr std::uint64_t kMostBytes = 16 << 20;
  return read_file(path, kMostBytes);
}

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
