#include "solidnoise/volume/merge_parts.h"

#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/part_file.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {
namespace {

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
    note_census(own, all, text, grid);
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
  require_complete(joined, first.whole);

  MergedVolume merged;
  take_description(first, merged);
  for (const openvdb::GridBase::Ptr& grid : whole) merged.volume.grids.push_back(measured(grid));
  finish_volume(merged.recipe, creator, merged.volume);
  return merged;
}

}  // namespace solidnoise
