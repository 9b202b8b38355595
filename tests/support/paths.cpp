#include "support/paths.h"

namespace solidnoise {

std::string in_source(const std::string& path) {
  return SOLIDNOISE_SOURCE_FOLDER "/" + path;
}

std::string in_build(const std::string& path) {
  return SOLIDNOISE_BUILD_FOLDER "/" + path;
}

}  // namespace solidnoise
