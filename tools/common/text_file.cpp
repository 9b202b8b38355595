#include "common/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

#include <fmt/format.h>

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
  if (path == "-") {
    std::cout << text << std::flush;
    errno = 0;
    if (!std::cout) fail("standard output", "cannot be written");
    return;
  }
  const fs::path temporary =
      path.parent_path() / fmt::format(".{}.tmp-{}", path.filename().string(), getpid());
  errno = 0;
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (!file) {
    const int reason = errno;
    fs::remove(temporary, error);
    errno = reason;
    fail(path, "cannot be written");
  }
  fs::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    errno = error.value();
    fail(path, "cannot be written");
  }
}

}  // namespace solidnoise
