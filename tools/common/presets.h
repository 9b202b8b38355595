#pragma once

#include <span>
#include <string_view>

namespace solidnoise {

// A recipe that comes with the program, from the file presets/NAME.json.
struct Preset {
  std::string_view name;
  std::string_view json;
};

// Those of this program; defined by the source that solidnoise_tool() in CMakeLists.txt makes of them.
std::span<const Preset> presets();

// Throws UsageError that lists the names if there is none of this one.
const Preset& find_preset(std::string_view name);

}  // namespace solidnoise
