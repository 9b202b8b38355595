#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "solidnoise/core/output_file.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Blosc is the best for floats; for half floats `none` is as small. OpenVDB applies zip to grids of other
// classes than fog volume and level set only, and on noise it gains nothing. With each, inactive voxels take
// no room.
enum class Codec { none, zip, blosc };

using MetadataValue = std::variant<std::string, std::int64_t, double, bool, Vec<3>>;
using Metadata = std::map<std::string, MetadataValue>;

// Sets the grid's metadata; a name that is there already gets the new value.
void set_metadata(openvdb::MetaMap& target, const Metadata& metadata);

// Sets what readers expect of a density: name, class "fog volume", creator. `half` is stored with
// grid.setSaveFloatAsHalf().
void set_fog_volume(openvdb::FloatGrid& grid, const std::string& name, const std::string& creator);

struct VdbWriteOptions {
  Codec codec = Codec::blosc;
  Existing existing = Existing::refuse;
  std::string creator = {};        // such as "vdbnoise 0.1.0"
  openvdb::MetaMap metadata = {};  // the file's other metadata; what the fields above and below say wins
  std::optional<int> frame = {};   // frame number
  std::optional<double> fps = {};  // frames per second
  Progress* progress = nullptr;    // asked for cancellation while writing
  OutputGroup* group = nullptr;    // with which the file appears
};

// Writes grids to a .vdb, all or nothing, as write_output does; what was written is opened again as a check.
// "-" writes to the standard output, without the grids' offsets. Throws std::runtime_error naming the path,
// OutputExists, Cancelled.
void write_vdb(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
               const VdbWriteOptions& options);

// Writes grids to a stream, without seeking. Throws std::runtime_error if the stream fails.
void write_vdb(std::ostream& stream, const openvdb::GridCPtrVec& grids, const VdbWriteOptions& options);

}  // namespace solidnoise
