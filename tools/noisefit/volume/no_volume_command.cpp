#include <stdexcept>

#include "common/flag_set.h"
#include "noisefit/commands.h"

namespace solidnoise {

int run_volume(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument.starts_with("--help")) {
      FlagSet("noisefit volume", "Is not there: this noisefit was built without OpenVDB.").parse({argument});
    }
  }
  throw std::runtime_error("this noisefit was built without OpenVDB and reads no volumes");
}

}  // namespace solidnoise
