#include "common/outputs.h"

#include <filesystem>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "common/run_tool.h"

namespace solidnoise {

void require_output(const std::string& path, Existing existing) {
  if (path != "-" && existing == Existing::refuse && std::filesystem::exists(path)) {
    throw std::runtime_error(path + " exists; --force replaces it");
  }
  require_writable(path, existing);
}

void require_outputs(const std::vector<std::string>& paths, Existing existing) {
  std::set<std::filesystem::path> outputs;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    if (!outputs.insert(std::filesystem::absolute(path).lexically_normal()).second) {
      throw UsageError(fmt::format("{} is the name of two outputs; each needs its own", path));
    }
    require_output(path, existing);
  }
}

}  // namespace solidnoise
