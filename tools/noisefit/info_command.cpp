#include <iostream>

#include "common/exit_status.h"
#include "common/flag_set.h"
#include "noisefit/commands.h"
#include "noisefit/describe.h"
#include "noisefit/model_file.h"

namespace solidnoise {

int run_info(const std::vector<std::string>& arguments) {
  std::string file;
  FlagSet flags("noisefit info", "Prints what is in a spectrum file: channels, bands, groups.");
  flags.argument("FILE", "The file", file);
  flags.parse(arguments);
  std::cout << describe(read_model(file));
  return kDone;
}

}  // namespace solidnoise
