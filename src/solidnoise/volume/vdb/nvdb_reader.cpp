#include "solidnoise/volume/vdb/nvdb_reader.h"

#include <cstdint>
#include <istream>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/NanoToOpenVDB.h>
#include <stdexcept>
#include <vector>

#include "solidnoise/volume/vdb/cancellable_file.h"
#include "solidnoise/volume/vdb/nvdb_check.h"

namespace solidnoise {
namespace {

template <typename BuildType>
openvdb::GridBase::Ptr convert(const nanovdb::HostBuffer& bytes, const char* stored_as) {
  check_nvdb_grid<BuildType>({bytes.data(), bytes.size()});
  const openvdb::GridBase::Ptr grid =
      nanovdb::nanoToOpenVDB(*reinterpret_cast<const nanovdb::NanoGrid<BuildType>*>(bytes.data()));
  grid->insertMeta("stored_as", openvdb::StringMetadata(stored_as));
  return grid;
}

openvdb::GridBase::Ptr convert(const nanovdb::HostBuffer& bytes, nanovdb::GridType type) {
  switch (type) {
    case nanovdb::GridType::Float:
      return convert<float>(bytes, "floats");
    case nanovdb::GridType::Fp16:
      return convert<nanovdb::Fp16>(bytes, "16 bits");
    case nanovdb::GridType::Fp8:
      return convert<nanovdb::Fp8>(bytes, "8 bits");
    case nanovdb::GridType::Fp4:
      return convert<nanovdb::Fp4>(bytes, "4 bits");
    case nanovdb::GridType::Vec3f:
      return convert<nanovdb::Vec3f>(bytes, "floats");
    default:
      throw std::runtime_error("it has a grid of other values than floats and vectors of them");
  }
}

}  // namespace

NvdbReader::NvdbReader(const std::filesystem::path& path, Progress* progress) {
  openvdb::initialize();
  CancellableFile file(path, progress);
  std::istream stream(&file);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  std::uint64_t left = std::filesystem::file_size(path);
  const auto read = [&](void* target, std::uint64_t bytes) {
    if (bytes > left) throw std::runtime_error("it ends too early");
    stream.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes));
    left -= bytes;
  };

  // Segments, of a header, descriptions of grids, and these.
  while (left > 0) {
    nanovdb::io::Header header;
    read(&header, sizeof(header));
    if (header.magic != NANOVDB_MAGIC_NUMBER) throw std::runtime_error("it is no NanoVDB file");
    if (header.codec != nanovdb::io::Codec::NONE) {
      throw std::runtime_error("its grids are compressed; nanovdb_convert writes them as they are");
    }
    std::vector<nanovdb::io::MetaData> described(header.gridCount);
    for (nanovdb::io::MetaData& grid : described) {
      read(&grid, sizeof(grid));
      std::vector<char> name(std::min<std::uint64_t>(grid.nameSize, left + 1));
      read(name.data(), grid.nameSize);
    }
    for (const nanovdb::io::MetaData& grid : described) {
      if (grid.gridSize > left || grid.gridSize == 0) throw std::runtime_error("it ends too early");
      auto bytes = nanovdb::HostBuffer::create(grid.gridSize);
      read(bytes.data(), grid.gridSize);
      throw_if_cancelled(progress);
      grids_.push_back(convert(bytes, grid.gridType));
    }
  }
}

}  // namespace solidnoise
