#include "solidnoise/volume/vdb/file_digest.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace solidnoise {
namespace {

constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325ULL;
constexpr std::uint64_t kPrime = 0x100000001b3ULL;

std::uint64_t add(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * kPrime;
  return hash;
}

std::string to_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::string digest(std::string_view bytes) {
  return to_text(add(kOffsetBasis, bytes));
}

std::string file_digest(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> chunk(std::size_t{1} << 20);
  std::uint64_t hash = kOffsetBasis;
  while (stream) {
    stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    hash = add(hash, {chunk.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (!stream.eof()) throw std::runtime_error(path.string() + ": cannot be read");
  return to_text(hash);
}

}  // namespace solidnoise
