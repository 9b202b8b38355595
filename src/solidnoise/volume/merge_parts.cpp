#include "solidnoise/volume/merge_parts.h"

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/core/random.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/vdb/grid_file.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

// Leaves of the topology, before empty ones are dropped: how many there are, and a number that tells which.
// Those of disjoint parts add up to those of the whole.
struct Census {
  std::int64_t leaves = 0;
  std::int64_t fingerprint = 0;  // the sum of the hashes of the leaves' origins, modulo 2^64

  void add(const Census& other) {
    leaves += other.leaves;
    fingerprint = static_cast<std::int64_t>(static_cast<std::uint64_t>(fingerprint) +
                                            static_cast<std::uint64_t>(other.fingerprint));
  }

  friend bool operator==(const Census&, const Census&) = default;
};

// Metadata of a census, of the part and of the whole.
struct CensusKeys {
  const char* leaves;
  const char* fingerprint;
};
constexpr CensusKeys kPartKeys{"solidnoise:part_leaves", "solidnoise:part_fingerprint"};
constexpr CensusKeys kWholeKeys{"solidnoise:whole_leaves", "solidnoise:whole_fingerprint"};
constexpr char kChecksumKey[] = "solidnoise:part_checksum";

struct PartFile {
  std::filesystem::path path;
  std::string recipe;  // JSON
  Census own;
  Census whole;
  VdbFile file;
};

Census take_census(const Topology& topology) {
  Census census;
  for (auto leaf = topology.mask->cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord& origin = leaf->origin();
    const std::uint64_t hash = hash_cell<3>({origin.x(), origin.y(), origin.z()}, 0);
    census.add({1, static_cast<std::int64_t>(hash)});
  }
  return census;
}

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

[[noreturn]] void refuse(const PartFile& part, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", part.path.string(), what));
}

PartFile read_part(const std::filesystem::path& path) {
  PartFile part{path, {}, {}, {}, read_grids(path)};
  const openvdb::GridBase& grid = *part.file.grids.front();
  const auto recipe = grid.getMetadata<openvdb::StringMetadata>(kRecipeKey);
  const std::optional<Census> own = noted_census(grid, kPartKeys);
  const std::optional<Census> whole = noted_census(grid, kWholeKeys);
  if (recipe == nullptr || !own || !whole) {
    refuse(part, "is not a part of a volume; parts are made by --shard or --region");
  }
  part.recipe = recipe->value();
  part.own = *own;
  part.whole = *whole;
  for (const openvdb::GridBase::Ptr& each : part.file.grids) {
    const auto noted = each->getMetadata<openvdb::Int64Metadata>(kChecksumKey);
    if (noted == nullptr || noted->value() != part_checksum(*each, part.recipe, *own, *whole)) {
      refuse(part, fmt::format("is damaged: the grid '{}' is not what was written", each->getName()));
    }
  }
  return part;
}

void require_same_volume(const PartFile& part, const PartFile& first) {
  const bool same = part.recipe == first.recipe && part.whole == first.whole &&
                    part.file.grids.size() == first.file.grids.size() &&
                    part.file.metadata == first.file.metadata;
  if (!same) refuse(part, fmt::format("is not of the same volume as {}", first.path.string()));
}

// Moves the leaves of a part's grid into the whole's.
template <typename Grid>
void take_leaves(const PartFile& part, Grid& from, Grid& to) {
  using Leaf = typename Grid::TreeType::LeafNodeType;
  std::vector<Leaf*> leaves;
  from.tree().stealNodes(leaves, from.background(), false);
  std::vector<std::unique_ptr<Leaf>> owned(leaves.begin(), leaves.end());
  for (auto& leaf : owned) {
    if (to.tree().probeConstLeaf(leaf->origin()) != nullptr) {
      refuse(part, "overlaps with another part");
    }
    to.tree().addLeaf(leaf.release());
  }
}

void add_part(PartFile& part, const std::vector<openvdb::GridBase::Ptr>& whole) {
  for (std::size_t i = 0; i < whole.size(); ++i) {
    openvdb::GridBase& from = *part.file.grids[i];
    if (from.type() != whole[i]->type()) refuse(part, "has grids of other types than the other parts");
    if (auto* floats = dynamic_cast<openvdb::FloatGrid*>(whole[i].get())) {
      take_leaves(part, static_cast<openvdb::FloatGrid&>(from), *floats);
    } else if (auto* vectors = dynamic_cast<openvdb::Vec3SGrid*>(whole[i].get())) {
      take_leaves(part, static_cast<openvdb::Vec3SGrid&>(from), *vectors);
    } else {
      refuse(part, fmt::format("has a grid of type {}, which no part has", from.valueType()));
    }
  }
}

MeasuredGrid measured(const openvdb::GridBase::Ptr& grid) {
  if (const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid)) return {grid, {measure(*floats)}};
  const auto moments = measure(*openvdb::gridPtrCast<openvdb::Vec3SGrid>(grid));
  return {grid, {moments.begin(), moments.end()}};
}

// An empty grid of the same type, background and transform, with no metadata yet.
openvdb::GridBase::Ptr empty_like(const openvdb::GridBase& grid) {
  openvdb::GridBase::Ptr result = grid.copyGridWithNewTree();
  result->clearMetadata();
  return result;
}

}  // namespace

void note_part(const VolumeRecipe& recipe, const std::string& creator, const Topology& whole,
               const Topology& part, Volume& volume) {
  const std::vector<std::string> names = grid_names(recipe);
  const Census own = take_census(part);
  const Census all = take_census(whole);
  const std::string text = format_json(to_json(recipe));
  for (std::size_t i = 0; i < volume.grids.size(); ++i) {
    openvdb::GridBase& grid = *volume.grids[i].grid;
    grid.setName(names[i]);
    grid.setCreator(creator);
    set_metadata(grid, {{kRecipeKey, text}});
    note_census(own, kPartKeys, grid);
    note_census(all, kWholeKeys, grid);
    set_metadata(grid, {{kChecksumKey, part_checksum(grid, text, own, all)}});
  }
}

MergedVolume merge_parts(const std::vector<std::filesystem::path>& files, const std::string& creator,
                         Progress* progress) {
  if (files.empty()) throw std::runtime_error("there are no parts to merge");
  PartFile first = read_part(files.front());
  std::vector<openvdb::GridBase::Ptr> whole;
  for (const openvdb::GridBase::Ptr& grid : first.file.grids) whole.push_back(empty_like(*grid));
  add_part(first, whole);
  Census joined = first.own;
  for (std::size_t i = 1; i < files.size(); ++i) {
    throw_if_cancelled(progress);
    if (progress != nullptr) progress->advance(i, files.size());
    PartFile part = read_part(files[i]);
    require_same_volume(part, first);
    add_part(part, whole);
    joined.add(part.own);
  }
  if (joined != first.whole) {
    const char* const fault = joined.leaves < first.whole.leaves ? "parts are missing"
                              : joined.leaves > first.whole.leaves
                                  ? "some are there twice"
                                  : "some are there twice, others are missing";
    throw std::runtime_error(
        fmt::format("these are not the parts of the volume: they have {} leaves, it has {}; {}",
                    joined.leaves, first.whole.leaves, fault));
  }

  MergedVolume merged;
  merged.recipe = volume_recipe_from_json(parse_json(first.recipe));
  const openvdb::MetaMap& metadata = first.file.metadata;
  if (const auto frame = metadata.getMetadata<openvdb::Int32Metadata>("frame")) merged.frame = frame->value();
  if (const auto fps = metadata.getMetadata<openvdb::DoubleMetadata>("fps")) merged.fps = fps->value();
  for (const openvdb::GridBase::Ptr& grid : whole) merged.volume.grids.push_back(measured(grid));
  finish_volume(merged.recipe, creator, merged.volume);
  return merged;
}

}  // namespace solidnoise
