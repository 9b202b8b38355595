#include "solidnoise/volume/vdb/nvdb_write.h"

#include <algorithm>
#include <cmath>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <new>
#include <ostream>
#include <stdexcept>

#include <fmt/format.h>

namespace solidnoise {
namespace {

using Handle = nanovdb::GridHandle<nanovdb::HostBuffer>;

template <typename BuildType, typename Grid>
Handle convert(const Grid& grid) {
  return nanovdb::openToNanoVDB<nanovdb::HostBuffer, typename Grid::TreeType, BuildType>(
      grid, nanovdb::StatsMode::All, nanovdb::ChecksumMode::Full);
}

template <typename BuildType>
double largest_error(const openvdb::FloatGrid& grid, const Handle& handle) {
  const auto accessor = handle.grid<BuildType>()->getAccessor();
  double error = 0.0;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
      const openvdb::Coord at = voxel.getCoord();
      const double stored = accessor.getValue(nanovdb::Coord(at.x(), at.y(), at.z()));
      error = std::max(error, std::abs(stored - static_cast<double>(*voxel)));
    }
  }
  return error;
}

struct Converted {
  Handle handle;
  double error = 0.0;
};

template <typename BuildType>
Converted convert_floats(const openvdb::FloatGrid& grid) {
  Converted result{convert<BuildType>(grid)};
  result.error = largest_error<BuildType>(grid, result.handle);
  return result;
}

Converted convert_floats(const openvdb::FloatGrid& grid, NvdbValues values) {
  switch (values) {
    case NvdbValues::bits16:
      return convert_floats<nanovdb::Fp16>(grid);
    case NvdbValues::bits8:
      return convert_floats<nanovdb::Fp8>(grid);
    case NvdbValues::bits4:
      return convert_floats<nanovdb::Fp4>(grid);
    case NvdbValues::floats:
      break;
  }
  return {convert<float>(grid)};
}

Converted convert(const openvdb::GridBase& grid, NvdbValues values) {
  if (grid.getName().size() >= nanovdb::GridData::MaxNameSize) {
    throw std::runtime_error("its name has more than 255 bytes");
  }
  if (!grid.transform().isLinear()) throw std::runtime_error("its transform is not affine");
  if (const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid)) {
    return convert_floats(*floats, values);
  }
  if (const auto* vectors = dynamic_cast<const openvdb::Vec3SGrid*>(&grid)) {
    return {convert<nanovdb::Vec3f>(*vectors)};
  }
  throw std::runtime_error(fmt::format("its values are {}; a .nvdb has float or vec3s", grid.valueType()));
}

// All before the values is known beforehand: nothing has to be sought.
void write_handles(std::ostream& stream, const std::vector<Handle>& handles) {
  nanovdb::io::Segment segment;
  for (const Handle& handle : handles) {
    segment.add(handle);
    segment.meta.back().fileSize = handle.size();
  }
  segment.write(stream);
  for (const Handle& handle : handles) {
    constexpr std::size_t kAtOnce = std::size_t{1} << 20;  // bytes: then cancellation is asked for
    for (std::size_t done = 0; done < handle.size(); done += kAtOnce) {
      stream.write(reinterpret_cast<const char*>(handle.data()) + done,
                   static_cast<std::streamsize>(std::min<std::size_t>(kAtOnce, handle.size() - done)));
    }
  }
  stream.flush();
}

}  // namespace

std::vector<double> write_nvdb(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                               const NvdbWriteOptions& options) {
  openvdb::initialize();
  std::vector<Handle> handles;
  std::vector<double> errors;
  for (const openvdb::GridBase::ConstPtr& grid : grids) {
    throw_if_cancelled(options.progress);
    try {
      Converted converted = convert(*grid, options.values);
      handles.push_back(std::move(converted.handle));
      errors.push_back(converted.error);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: grid '{}' cannot be written as NanoVDB: {}", path.string(),
                                           grid->getName(), error.what()));
    }
  }
  write_output(path, {options.existing, options.progress, {}, options.group},
               [&](std::ostream& stream) { write_handles(stream, handles); });
  return errors;
}

}  // namespace solidnoise
