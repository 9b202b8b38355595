#include "solidnoise/volume/part_file.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/digest.h"
#include "solidnoise/core/random.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {

void Census::add(const Census& other) {
  leaves += other.leaves;
  fingerprint = static_cast<std::int64_t>(static_cast<std::uint64_t>(fingerprint) +
                                          static_cast<std::uint64_t>(other.fingerprint));
}

Census take_census(const Topology& topology) {
  Census census;
  for (auto leaf = topology.mask->cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord& origin = leaf->origin();
    const std::uint64_t hash = hash_cell<3>({origin.x(), origin.y(), origin.z()}, 0);
    census.add({1, static_cast<std::int64_t>(hash)});
  }
  return census;
}

namespace {

// Metadata of a census, of the part and of the whole.
struct CensusKeys {
  const char* leaves;
  const char* fingerprint;
};
constexpr CensusKeys kPartKeys{"solidnoise:part_leaves", "solidnoise:part_fingerprint"};
constexpr CensusKeys kWholeKeys{"solidnoise:whole_leaves", "solidnoise:whole_fingerprint"};
constexpr char kChecksumKey[] = "solidnoise:part_checksum";

void note_census(const Census& census, const CensusKeys& keys, openvdb::GridBase& grid) {
  set_metadata(grid, {{keys.leaves, census.leaves}, {keys.fingerprint, census.fingerprint}});
}

std::optional<Census> noted_census(const openvdb::GridBase& grid, const CensusKeys& keys) {
  const auto leaves = grid.getMetadata<openvdb::Int64Metadata>(keys.leaves);
  const auto fingerprint = grid.getMetadata<openvdb::Int64Metadata>(keys.fingerprint);
  if (leaves == nullptr || fingerprint == nullptr) return std::nullopt;
  return Census{leaves->value(), fingerprint->value()};
}

// Of all that a merged volume takes from a part's grid: its place, topology and values, and its recipe.
std::int64_t part_checksum(const openvdb::GridBase& grid, const std::string& recipe, const Census& own,
                           const Census& whole) {
  const std::string text = fmt::format("{:x} {} {} {} {} {} {}", checksum(grid), own.leaves, own.fingerprint,
                                       whole.leaves, whole.fingerprint, grid.saveFloatAsHalf(), recipe);
  constexpr int kHexadecimal = 16;
  return static_cast<std::int64_t>(std::stoull(digest(text), nullptr, kHexadecimal));
}

// Takes what note_part() has noted, but for the checksums; returns whether it is there.
bool take_notes(PartFile& part) {
  const openvdb::GridBase& grid = *part.file.grids.front();
  const auto recipe = grid.getMetadata<openvdb::StringMetadata>(kRecipeKey);
  const std::optional<Census> own = noted_census(grid, kPartKeys);
  const std::optional<Census> whole = noted_census(grid, kWholeKeys);
  if (recipe == nullptr || !own || !whole) return false;
  part.recipe = recipe->value();
  part.own = *own;
  part.whole = *whole;
  return true;
}

bool is_as_noted(const PartFile& part, const openvdb::GridBase& grid) {
  const auto noted = grid.getMetadata<openvdb::Int64Metadata>(kChecksumKey);
  return noted != nullptr && noted->value() == part_checksum(grid, part.recipe, part.own, part.whole);
}

}  // namespace

void note_census(const Census& own, const Census& whole, const std::string& recipe, openvdb::GridBase& grid) {
  set_metadata(grid, {{kRecipeKey, recipe}});
  note_census(own, kPartKeys, grid);
  note_census(whole, kWholeKeys, grid);
  set_metadata(grid, {{kChecksumKey, part_checksum(grid, recipe, own, whole)}});
}

void refuse(const PartFile& part, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", part.path.string(), what));
}

PartFile read_part(const std::filesystem::path& path) {
  PartFile part{path, read_grids(path)};
  if (!take_notes(part)) refuse(part, "is not a part of a volume; parts are made by --shard or --region");
  for (const openvdb::GridBase::Ptr& each : part.file.grids) {
    if (is_as_noted(part, *each)) continue;
    refuse(part, fmt::format("is damaged: the grid '{}' is not what was written", each->getName()));
  }
  return part;
}

bool is_sound_part(const std::filesystem::path& path) {
  PartFile part{path, read_grids(path)};
  return take_notes(part) && std::ranges::all_of(part.file.grids, [&](const openvdb::GridBase::Ptr& grid) {
           return is_as_noted(part, *grid);
         });
}

void require_same_volume(const PartFile& part, const PartFile& first) {
  const bool same = part.recipe == first.recipe && part.whole == first.whole &&
                    part.file.grids.size() == first.file.grids.size() &&
                    part.file.metadata == first.file.metadata;
  if (!same) refuse(part, fmt::format("is not of the same volume as {}", first.path.string()));
}

void require_complete(const Census& joined, const Census& whole) {
  if (joined == whole) return;
  const char* const fault = joined.leaves < whole.leaves   ? "parts are missing"
                            : joined.leaves > whole.leaves ? "some are there twice"
                                                           : "some are there twice, others are missing";
  throw std::runtime_error(
      fmt::format("these are not the parts of the volume: they have {} leaves, it has {}; {}", joined.leaves,
                  whole.leaves, fault));
}

void take_description(const PartFile& part, MergedVolume& merged) {
  merged.recipe = volume_recipe_from_json(parse_json(part.recipe));
  const openvdb::MetaMap& metadata = part.file.metadata;
  if (const auto frame = metadata.getMetadata<openvdb::Int32Metadata>("frame")) merged.frame = frame->value();
  if (const auto fps = metadata.getMetadata<openvdb::DoubleMetadata>("fps")) merged.fps = fps->value();
}

}  // namespace solidnoise
