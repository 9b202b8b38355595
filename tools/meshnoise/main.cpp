#include <fmt/format.h>

#include "common/flag_set.h"
#include "common/run_tool.h"
#include "meshnoise/commands.h"

namespace solidnoise {
namespace {

constexpr char kHelp[] =
    "meshnoise bakes procedural noise onto surfaces, as vertex colours, without texture coordinates.\n"
    "Usage: meshnoise COMMAND ...\n"
    "  meshnoise bake IN --out OUT.ply        bakes noise; --help lists what it can do\n"
    "  meshnoise curvature IN --out OUT.ply   shows the curvature as colours\n"
    "  meshnoise info FILE                    prints what a mesh is like, and its stored recipe\n"
    "Meshes are .ply, .obj, .off, .stl or .om files.\n";

}  // namespace

int run_meshnoise(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw UsageError("a command is missing; it must be bake, curvature or info");
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  const std::string& command = arguments[0];
  if (command == "bake") return run_command("meshnoise bake", [&] { return run_bake(rest); });
  if (command == "curvature") return run_command("meshnoise curvature", [&] { return run_curvature(rest); });
  if (command == "info") return run_command("meshnoise info", [&] { return run_info(rest); });
  if (command == "--list-presets" || command == "--schema") return run_bake(arguments);
  if (command == "--help" || command == "-h") throw TextRequested{kHelp};
  if (command == "--version") throw TextRequested{std::string(kMeshnoise) + "\n"};
  throw UsageError(fmt::format("{} is no command; it must be bake, curvature or info", command));
}

}  // namespace solidnoise

int main(int argc, char** argv) {
  return solidnoise::run_tool("meshnoise", [&] {
    return solidnoise::run_meshnoise({argv + 1, argv + argc});
  });
}
