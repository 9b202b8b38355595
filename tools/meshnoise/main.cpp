#include <fmt/format.h>

#include "common/flag_set.h"
#include "common/run_tool.h"
#include "meshnoise/commands.h"
#include "solidnoise/core/printable.h"

namespace {

using namespace solidnoise;

constexpr char kDescription[] =
    "meshnoise bakes procedural noise onto surfaces, as vertex colours, without texture coordinates.\n"
    "  meshnoise bake IN --out OUT.ply        bakes noise; meshnoise bake --help says how\n"
    "  meshnoise curvature IN --out OUT.ply   shows the curvature as colours\n"
    "  meshnoise farm IN --out OUT.####.ply   has many machines bake a sequence\n"
    "  meshnoise info FILE                    prints what a mesh is like, and its stored recipe";

// Without a command: what is asked about all of them.
int run_without(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw UsageError("a command is missing; it must be bake, curvature, info or farm");
  const std::string& first = arguments.front();
  if (first == "--list-presets" || first == "--schema") return run_bake(arguments);
  if (!first.starts_with('-')) {
    throw UsageError(
        fmt::format("{} is no command; it must be bake, curvature, info or farm", printable(first)));
  }
  std::string command;
  FlagSet flags("meshnoise", kDescription);
  flags.argument("COMMAND", "bake, curvature, info or farm", command);
  flags.version(kMeshnoise);
  flags.parse(arguments);
  flags.apply();
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr Command kCommands[] = {
      {"bake", run_bake}, {"curvature", run_curvature}, {"info", run_info}, {"farm", run_farm}};
  return run_tool("meshnoise", [&] {
    return run_commands("meshnoise", kCommands, {argv + 1, argv + argc}, run_without);
  });
}
