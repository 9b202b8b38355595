#include "common/recipe_files.h"

#include <cstdint>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run_tool.h"
#include "solidnoise/core/input_file.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {
namespace {

constexpr std::uint64_t kMostBytes = 16 << 20;

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
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

const Preset& find_preset(std::string_view name) {
  std::string names;
  for (const Preset& preset : presets()) {
    if (preset.name == name) return preset;
    names += (names.empty() ? "" : ", ") + std::string(preset.name);
  }
  throw UsageError(fmt::format("--preset is {}; it must be one of {}", printable(name), names));
}

}  // namespace solidnoise
