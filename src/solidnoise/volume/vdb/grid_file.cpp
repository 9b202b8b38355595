#include "solidnoise/volume/vdb/grid_file.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/volume/vdb/vdb_read.h"

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

void GridFile::validate() const {
  if (file.empty()) throw std::invalid_argument("file is empty; it must be a .vdb");
}

std::optional<GridFile> parse_grid_file(std::string_view text) {
  constexpr std::string_view kExtension = ".vdb";
  if (text.size() > kExtension.size() && text.ends_with(kExtension)) return GridFile{std::string(text)};
  const std::size_t extension = text.rfind(".vdb:");
  if (extension == std::string_view::npos || extension == 0) return std::nullopt;
  const std::size_t colon = extension + kExtension.size();
  if (colon + 1 == text.size()) return std::nullopt;
  return GridFile{std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
}

void note_digest(const std::string& file, const std::string& flag, std::string& digest) {
  const std::string found = file_digest(file);
  if (!digest.empty() && digest != found) {
    throw std::runtime_error(
        fmt::format("{}: is not the file that the recipe was made with (its digest is {}, the recipe's {}); "
                    "name it as {} to use it as it is",
                    file, found, digest, flag));
  }
  digest = found;
}

openvdb::GridBase::Ptr read_grid(GridFile& source, const std::string& flag) {
  const openvdb::GridBase::Ptr grid = read_grid(source.file, source.grid);
  note_digest(source.file, flag, source.digest);
  return grid;
}

openvdb::FloatGrid::Ptr read_float_grid(GridFile& source, const std::string& flag) {
  const openvdb::FloatGrid::Ptr grid = read_float_grid(source.file, source.grid);
  note_digest(source.file, flag, source.digest);
  return grid;
}

openvdb::GridBase::Ptr read_vector_grid(GridFile& source, const std::string& flag) {
  const openvdb::GridBase::Ptr grid = read_vector_grid(source.file, source.grid);
  note_digest(source.file, flag, source.digest);
  return grid;
}

}  // namespace solidnoise
