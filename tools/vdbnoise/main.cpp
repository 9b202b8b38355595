#include "common/run_tool.h"
#include "vdbnoise/commands.h"

namespace solidnoise {

int run_vdbnoise(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return run_make({});
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (arguments[0] == "make") return run_make(rest);
  if (arguments[0] == "merge") return run_command("vdbnoise merge", [&] { return run_merge(rest); });
  if (arguments[0] == "surface") return run_command("vdbnoise surface", [&] { return run_surface(rest); });
  if (arguments[0] == "info") return run_command("vdbnoise info", [&] { return run_info(rest); });
  if (arguments[0] == "analyze") return run_command("vdbnoise analyze", [&] { return run_analyze(rest); });
  if (arguments[0] == "slice") return run_command("vdbnoise slice", [&] { return run_slice(rest); });
  return run_make(arguments);
}

}  // namespace solidnoise

int main(int argc, char** argv) {
  return solidnoise::run_tool("vdbnoise", [&] { return solidnoise::run_vdbnoise({argv + 1, argv + argc}); });
}
