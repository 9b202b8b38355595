#include <stdexcept>

#include "noisefit/commands.h"

namespace solidnoise {

int run_volume(const std::vector<std::string>&) {
  throw std::runtime_error("this noisefit was built without OpenVDB and reads no volumes");
}

}  // namespace solidnoise
