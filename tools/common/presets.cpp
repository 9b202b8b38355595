#include "common/presets.h"

#include <string>

#include <fmt/format.h>

#include "common/usage_error.h"

namespace solidnoise {

const Preset& find_preset(std::string_view name) {
  std::string names;
  for (const Preset& preset : presets()) {
    if (preset.name == name) return preset;
    names += (names.empty() ? "" : ", ") + std::string(preset.name);
  }
  throw UsageError(fmt::format("--preset is {}; it must be one of {}", name, names));
}

}  // namespace solidnoise
