#include <iostream>

#include "common/flag_set.h"
#include "common/run_tool.h"
#include "noisefit/commands.h"
#include "noisefit/model_file.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"

namespace {

using namespace solidnoise;

int run_info(const std::vector<std::string>& arguments) {
  std::string file;
  FlagSet flags("noisefit info", "Prints what is in a spectrum file: channels, bands, groups.");
  flags.argument("FILE", "The file, - for the standard input", file);
  flags.parse(arguments);
  flags.apply();
  const ExemplarFile exemplar = read_model(file);
  std::cout << describe(exemplar.model) << describe_scale(exemplar);
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr Command kCommands[] = {{"volume", run_volume}, {"info", run_info}, {"edit", run_edit}};
  return run_tool("noisefit", [&] {
    return run_commands("noisefit", kCommands, {argv + 1, argv + argc}, run_fit);
  });
}
