#pragma once

#include <string>
#include <vector>

namespace solidnoise {

inline constexpr char kNoisefit[] = "noisefit " SOLIDNOISE_VERSION;  // name and version

// The commands of noisefit. `arguments` follow the command's name, if it has one. Each returns an exit
// status, and throws what run_tool() expects.
int run_fit(const std::vector<std::string>& arguments);
int run_volume(const std::vector<std::string>& arguments);
int run_edit(const std::vector<std::string>& arguments);

}  // namespace solidnoise
