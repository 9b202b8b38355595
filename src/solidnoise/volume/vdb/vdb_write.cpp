#include "solidnoise/volume/vdb/vdb_write.h"

#include <ostream>
#include <stdexcept>

#include <fmt/format.h>
#include <openvdb/io/Compression.h>

#include "solidnoise/volume/vdb/grid_archive.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_reader.h"

namespace solidnoise {
namespace {

std::uint32_t compression_flags(Codec codec) {
  using namespace openvdb::io;
  switch (codec) {
    case Codec::none:
      return COMPRESS_ACTIVE_MASK;
    case Codec::zip:
      return COMPRESS_ACTIVE_MASK | COMPRESS_ZIP;
    case Codec::blosc:
      return COMPRESS_ACTIVE_MASK | COMPRESS_BLOSC;
  }
  return COMPRESS_ACTIVE_MASK;
}

openvdb::MetaMap file_metadata(const VdbWriteOptions& options) {
  openvdb::MetaMap result = options.metadata;
  Metadata own;
  if (!options.creator.empty()) own["creator"] = options.creator;
  set_metadata(result, own);
  const auto set = [&](const char* name, const openvdb::Metadata& value) {
    result.removeMeta(name);
    result.insertMeta(name, value);
  };
  if (options.frame) set("frame", openvdb::Int32Metadata(*options.frame));
  if (options.fps) set("fps", openvdb::DoubleMetadata(*options.fps));
  return result;
}

// Of all that is in a file.
std::uint64_t identity_of(const openvdb::MetaMap& metadata, const openvdb::GridCPtrVec& grids) {
  std::string all = metadata.str();
  for (const auto& grid : grids) {
    all += fmt::format("{}{}{:x}\n", grid->str(), grid->saveFloatAsHalf(), checksum(*grid));
  }
  constexpr int kHexadecimal = 16;
  return std::stoull(digest(all), nullptr, kHexadecimal);
}

void write_archive(std::ostream& stream, GridArchive::Offsets offsets, const openvdb::GridCPtrVec& grids,
                   const VdbWriteOptions& options) {
  openvdb::initialize();
  GridArchive archive;
  archive.setCompression(compression_flags(options.codec));
  GridArchive::Contents contents{{}, file_metadata(options), {}};
  for (const auto& grid : grids) contents.grids.push_back(parallel_grid(grid));
  contents.identity = [&] { return identity_of(contents.metadata, grids); };
  archive.write_grids(stream, offsets, contents);
  stream.flush();
}

// Opens what was written, and reads all but the values: those went through checked writes.
void verify(const std::filesystem::path& written, const std::string& name, std::size_t grids) {
  std::size_t found = 0;
  try {
    VdbReader reader(written);
    for (; found < reader.grid_count(); ++found) reader.read_header(found);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: what was written cannot be read again: {}", name, error.what()));
  }
  if (found != grids) throw std::runtime_error(fmt::format("{}: what was written lacks grids", name));
}

}  // namespace

void set_metadata(openvdb::MetaMap& target, const Metadata& metadata) {
  for (const auto& [name, value] : metadata) {
    target.removeMeta(name);
    if (const auto* text = std::get_if<std::string>(&value)) {
      target.insertMeta(name, openvdb::StringMetadata(*text));
    } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      target.insertMeta(name, openvdb::Int64Metadata(*integer));
    } else if (const auto* real = std::get_if<double>(&value)) {
      target.insertMeta(name, openvdb::DoubleMetadata(*real));
    } else if (const auto* vector = std::get_if<Vec<3>>(&value)) {
      target.insertMeta(name, openvdb::Vec3DMetadata(openvdb::Vec3d(vector->x, vector->y, vector->z)));
    } else {
      target.insertMeta(name, openvdb::BoolMetadata(std::get<bool>(value)));
    }
  }
}

void set_fog_volume(openvdb::FloatGrid& grid, const std::string& name, const std::string& creator) {
  grid.setName(name);
  grid.setGridClass(openvdb::GRID_FOG_VOLUME);
  grid.setCreator(creator);
}

void write_vdb(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
               const VdbWriteOptions& options) {
  const auto offsets = path == "-" ? GridArchive::Offsets::none : GridArchive::Offsets::write;
  const auto verify_written = [&](const std::filesystem::path& written) {
    verify(written, path.string(), grids.size());
  };
  write_output(path, {options.existing, options.progress, verify_written, options.group},
               [&](std::ostream& stream) { write_archive(stream, offsets, grids, options); });
}

void write_vdb(std::ostream& stream, const openvdb::GridCPtrVec& grids, const VdbWriteOptions& options) {
  write_archive(stream, GridArchive::Offsets::none, grids, options);
  if (!stream) throw std::runtime_error("writing to the stream failed");
}

}  // namespace solidnoise
