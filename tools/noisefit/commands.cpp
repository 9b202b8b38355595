#include "noisefit/commands.h"

#include "common/exit_status.h"
#include "common/flag_set.h"
#include "common/usage_error.h"

namespace solidnoise {

int run_noisefit(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    throw UsageError(
        "an exemplar or a command is missing; say noisefit sand.png --out sand.json, or info, edit");
  }
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (arguments[0] == "volume") return run_command("noisefit volume", [&] { return run_volume(rest); });
  if (arguments[0] == "info") return run_command("noisefit info", [&] { return run_info(rest); });
  if (arguments[0] == "edit") return run_command("noisefit edit", [&] { return run_edit(rest); });
  if (arguments[0] == "--version") throw TextRequested{std::string(kNoisefit) + "\n"};
  return run_fit(arguments);
}

}  // namespace solidnoise
