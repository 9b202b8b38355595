#include "common/recipe_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run_tool.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 16 << 20;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  const std::string reason = errno != 0 ? fmt::format(": {}", std::strerror(errno)) : std::string();
  throw std::runtime_error(fmt::format("{}: {}{}", path.string(), what, reason));
}

}  // namespace

std::string read_text_file(const fs::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) fail(path, "cannot be read");
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) fail(path, "cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  errno = 0;
  if (text.size() > kMostBytes) fail(path, "is too large for a recipe");
  return text;
}

void write_text_file(const fs::path& path, const std::string& text) {
  write_output(path, {.existing = Existing::replace}, [&](std::ostream& stream) { stream << text; });
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
  throw UsageError(fmt::format("--preset is {}; it must be one of {}", name, names));
}

}  // namespace solidnoise
