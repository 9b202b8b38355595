#include "solidnoise/core/digest.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace solidnoise {
namespace {

// FNV-1a.
class Fnv {
 public:
  void add(std::string_view bytes) {
    constexpr std::uint64_t kPrime = 0x100000001b3ULL;
    for (const char byte : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * kPrime;
  }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::string digest(std::string_view bytes) {
  Fnv hash;
  hash.add(bytes);
  return hash.text();
}

std::string file_digest(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> chunk(std::size_t{1} << 20);
  Fnv hash;
  while (stream) {
    stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    hash.add({chunk.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (!stream.eof()) throw std::runtime_error(path.string() + ": cannot be read");
  return hash.text();
}

}  // namespace solidnoise
