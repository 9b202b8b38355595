#include "common/outputs.h"

#include <filesystem>
#include <stdexcept>

namespace solidnoise {

void require_output(const std::string& path, Existing existing) {
  if (path != "-" && existing == Existing::refuse && std::filesystem::exists(path)) {
    throw std::runtime_error(path + " exists; --force replaces it");
  }
  require_writable(path, existing);
}

}  // namespace solidnoise
