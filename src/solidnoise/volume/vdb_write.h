#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "solidnoise/volume/openvdb.h"
#include "solidnoise/volume/progress.h"

namespace solidnoise {

// Blosc is the best for floats; for half floats `none` is as small. OpenVDB applies zip to grids of other
// classes than fog volume and level set only, and on noise it gains nothing. With each, inactive voxels take
// no room.
enum class Codec { none, zip, blosc };

enum class Existing { refuse, replace };

using MetadataValue = std::variant<std::string, std::int64_t, double, bool>;
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
  std::optional<int> frame = {};   // frame number
  std::optional<double> fps = {};  // frames per second
  Progress* progress = nullptr;    // asked for cancellation while writing
};

// The output exists and was not to be replaced. The message names the path.
class OutputExists : public std::runtime_error {
 public:
  explicit OutputExists(const std::filesystem::path& path)
      : std::runtime_error(path.string() + ": exists already") {}
};

// Throws std::runtime_error naming the path if write_vdb could not begin: a folder that is not there or not
// writable, a path that is a folder or device; OutputExists if there is a file that is not to be replaced.
// "-" always passes. For a tool to call before hours of work.
void require_writable(const std::filesystem::path& path, Existing existing);

// Writes grids to a .vdb, all or nothing: into a file `.NAME.tmp-PID-RANDOM` beside the target, synchronised
// with the disk, opened again as a check, then renamed. Every write is checked, so that a full disk is
// reported. On any failure the temporary file is removed. "-" writes to the standard output.
// Throws std::runtime_error naming the path, OutputExists, Cancelled.
//
// A program that is interrupted should set the flag behind Progress::cancelled() in its signal handler: it is
// looked at for every megabyte written, and the exception removes the temporary file.
void write_vdb(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
               const VdbWriteOptions& options);

// Writes grids to a stream, without seeking. Throws std::runtime_error if the stream fails.
void write_vdb(std::ostream& stream, const openvdb::GridCPtrVec& grids, const VdbWriteOptions& options);

}  // namespace solidnoise
