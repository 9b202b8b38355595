#pragma once

#include <string>
#include <vector>

namespace solidnoise {

inline constexpr char kMeshnoise[] = "meshnoise " SOLIDNOISE_VERSION;  // name and version, in every file

// The commands of meshnoise. `arguments` follow the command's name. Each returns an exit status, and throws
// what run_tool() expects.
int run_bake(const std::vector<std::string>& arguments);
int run_curvature(const std::vector<std::string>& arguments);
int run_farm(const std::vector<std::string>& arguments);
int run_info(const std::vector<std::string>& arguments);

}  // namespace solidnoise
