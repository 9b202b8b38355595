#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nanovdb/util/IO.h>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/file_in_memory.h"
#include "solidnoise/volume/vdb/nvdb_reader.h"
#include "solidnoise/volume/vdb/nvdb_write.h"
#include "solidnoise/volume/vdb/vdb_write.h"

// A .nvdb is hundreds of kilobytes, nearly all of them 0. So the input says what becomes of one that is
// whole: its first byte, which kind of values; then, ten bytes each, a word that is not 0 or near to one
// such, and what stands there instead. Its checksum is taken out, for it would stop most of them.

namespace solidnoise {
namespace {

constexpr std::size_t kWord = 8;

struct WholeFile {
  std::vector<std::uint8_t> bytes;
  std::vector<std::size_t> words;  // where those begin that are changed
};

std::vector<std::uint8_t> bytes_of(const openvdb::GridCPtrVec& grids, NvdbValues values) {
  std::string folder = std::filesystem::temp_directory_path() / "nvdb-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) std::abort();
  const std::filesystem::path path = std::filesystem::path(folder) / "whole.nvdb";
  write_nvdb(path, grids, {.values = values});
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file),
                                        std::istreambuf_iterator<char>()};
  std::filesystem::remove_all(folder);
  return bytes;
}

WholeFile whole_file(const openvdb::GridBase::Ptr& grid, NvdbValues values) {
  WholeFile file{bytes_of({grid}, values), {}};
  const std::size_t begin =
      sizeof(nanovdb::io::Header) + sizeof(nanovdb::io::MetaData) + grid->getName().size() + 1;
  std::memset(file.bytes.data() + begin + kWord, 0xff, kWord);  // no checksum, behind the magic number
  constexpr std::size_t kNear = 4;                              // words
  std::size_t last = 0;
  for (std::size_t word = 0; word + kWord <= file.bytes.size(); word += kWord) {
    const auto* const at = file.bytes.data() + word;
    if (std::any_of(at, at + kWord, [](std::uint8_t byte) { return byte != 0; })) last = word;
    if (word - last <= kNear * kWord) file.words.push_back(word);
  }
  return file;
}

std::vector<WholeFile> whole_files() {
  openvdb::initialize();
  const auto floats = openvdb::FloatGrid::create();
  floats->setName("density");
  for (int i = 0; i < 12; ++i) floats->tree().setValueOn({i, i / 2, -i}, 0.1f * static_cast<float>(i));
  floats->tree().addTile(1, {64, 64, 64}, 0.5f, true);
  const auto vectors = openvdb::Vec3SGrid::create({0.0f, 0.0f, 0.0f});
  vectors->setName("vel");
  vectors->tree().setValueOn({1, 2, 3}, {0.1f, -2.0f, 1.0f});
  return {whole_file(floats, NvdbValues::floats), whole_file(floats, NvdbValues::bits16),
          whole_file(floats, NvdbValues::bits8), whole_file(floats, NvdbValues::bits4),
          whole_file(vectors, NvdbValues::floats)};
}

std::vector<std::uint8_t> changed(const WholeFile& whole, const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes = whole.bytes;
  for (; size >= 2 + kWord; data += 2 + kWord, size -= 2 + kWord) {
    const std::size_t place = static_cast<std::size_t>(data[0]) | static_cast<std::size_t>(data[1]) << 8;
    std::memcpy(bytes.data() + whole.words[place % whole.words.size()], data + 2, kWord);
  }
  return bytes;
}

}  // namespace
}  // namespace solidnoise

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidnoise;
  static const std::vector<WholeFile> files = whole_files();
  static const FileInMemory file;
  if (size == 0) return 0;
  file.write(changed(files[*data % files.size()], data + 1, size - 1));
  try {
    NvdbReader reader(file.path());
    const openvdb::GridPtrVec grids = reader.read_grids();
    std::ostringstream stream;
    write_vdb(stream, {grids.begin(), grids.end()}, {.codec = Codec::none});
  } catch (const std::exception&) {  // which read_grids() turns into errors that name the file
  }
  return 0;
}
