#pragma once

#include <string>
#include <vector>

namespace solidnoise {

inline constexpr char kVdbnoise[] = "vdbnoise " SOLIDNOISE_VERSION;  // name and version, in every file

// The commands of vdbnoise. `arguments` follow the command's name. Each returns an exit status, and throws
// what run_tool() expects.
int run_make(const std::vector<std::string>& arguments);
int run_merge(const std::vector<std::string>& arguments);
int run_surface(const std::vector<std::string>& arguments);
int run_info(const std::vector<std::string>& arguments);
int run_analyze(const std::vector<std::string>& arguments);
int run_sky(const std::vector<std::string>& arguments);
int run_slice(const std::vector<std::string>& arguments);
int run_farm(const std::vector<std::string>& arguments);

}  // namespace solidnoise
