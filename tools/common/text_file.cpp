#include "common/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <ostream>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/core/output_file.h"

namespace solidnoise {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 16 << 20;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  const std::string reason = errno != 0 ? fmt::format(": {}", std::strerror(errno)) : std::string();
  throw std::runtime_error(fmt::format("{}: {}{}", path.string(), what, reason));
}

}  // namespace

std::string read_text_file(const fs::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) fail(path, "cannot be read");
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) fail(path, "cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  errno = 0;
  if (text.size() > kMostBytes) fail(path, "is too large for a recipe");
  return text;
}

void write_text_file(const fs::path& path, const std::string& text) {
  write_output(path, {.existing = Existing::replace}, [&](std::ostream& stream) { stream << text; });
}

}  // namespace solidnoise
