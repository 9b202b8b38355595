#include <iostream>

#include "common/flag_set.h"
#include "common/run_tool.h"
#include "noisefit/commands.h"
#include "noisefit/model_file.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"

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

int run_info(const std::vector<std::string>& arguments) {
  std::string file;
  FlagSet flags("noisefit info", "Prints what is in a spectrum file: channels, bands, groups.");
  flags.argument("FILE", "The file", file);
  flags.parse(arguments);
  std::cout << describe(read_model(file));
  return kDone;
}

}  // namespace solidnoise

int main(int argc, char** argv) {
  return solidnoise::run_tool("noisefit", [&] { return solidnoise::run_noisefit({argv + 1, argv + argc}); });
}
