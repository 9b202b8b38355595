#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "solidnoise/core/vec.h"
#include "solidnoise/volume/topology/topology.h"

namespace solidnoise {

// A part of a volume, made by itself: on another machine, or where the whole does not fit into the memory.
// Parts are made of whole leaves, and hold the same values as the whole. The shards of a volume have no voxel
// in common and together have all of them; so have regions that share no more than their faces and cover the
// volume.
struct VolumePart {
  std::optional<Box<3>> region{};  // world units; leaves whose first voxel's centre c has lower <= c < upper
  int shard = 1;                   // of the leaves in the region: 1 to shards
  int shards = 1;                  // parts that cost about the same, 1 to 65536

  bool whole() const { return !region && shards == 1; }

  // Throws std::invalid_argument naming the field, its value and what is allowed.
  void validate() const;
};

// "3/8", and the corners of the region, if there is one.
std::string text_of(const VolumePart& part);

// Whether voxels cost nothing, for nothing is to be made in all of a box.
using IsFree = std::function<bool(const openvdb::CoordBBox& voxels)>;

// The part's leaves of a topology; they may be none. Shards are runs of blocks of 32^3 voxels, the blocks
// that impulses are made for once, in the order of their coordinates, with as many leaves each that are not
// free. All leaves are where there is no `is_free`; it is called by many threads.
Topology take_part(const Topology& topology, const VolumePart& part, const IsFree& is_free = {});

// Bytes that making a part of so many channels takes at most, where the whole takes `whole_memory`. The
// topology is made whole.
std::uint64_t estimate_part_memory(std::uint64_t whole_memory, const GridFrame& frame, const VolumePart& part,
                                   int channels);

}  // namespace solidnoise
