#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/topology/topology.h"
#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {

// Leaves of a topology, before empty ones are dropped: how many there are, and a number that tells which.
// Those of disjoint parts add up to those of the whole.
struct Census {
  std::int64_t leaves = 0;
  std::int64_t fingerprint = 0;  // the sum of the hashes of the leaves' origins, modulo 2^64

  void add(const Census& other);

  friend bool operator==(const Census&, const Census&) = default;
};
Census take_census(const Topology& topology);

// The file of a part of a volume, and what note_part() has noted in it.
struct PartFile {
  std::filesystem::path path;
  VdbFile file;
  std::string recipe{};  // of the whole, as JSON
  Census own{};
  Census whole{};
};

// Reads a part. Throws std::runtime_error naming the file if it is no part, or not what note_part() saw; what
// read_grids() throws.
PartFile read_part(const std::filesystem::path& path);

// Notes the census of a part and of the whole, and checksums, in a part's grids.
void note_census(const Census& own, const Census& whole, const std::string& recipe, openvdb::GridBase& grid);

// Refuse what does not fit together: std::runtime_error. The parts' censuses are to add up to `joined`.
[[noreturn]] void refuse(const PartFile& part, const std::string& what);
void require_same_volume(const PartFile& part, const PartFile& first);
void require_complete(const Census& joined, const Census& whole);

// The recipe, frame and frames per second of the whole that a part is of.
void take_description(const PartFile& part, MergedVolume& merged);

}  // namespace solidnoise
