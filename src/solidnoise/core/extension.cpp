#include "solidnoise/core/extension.h"

#include <algorithm>

namespace solidnoise {

std::string lowered(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

std::string extension_of(const std::filesystem::path& path) {
  return lowered(path.extension().string());
}

}  // namespace solidnoise
