#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/part_file.h"
#include "solidnoise/volume/slab_density.h"
#include "solidnoise/volume/vdb/parts_grid.h"
#include "solidnoise/volume/vdb/streamed_grid.h"

namespace solidnoise {
namespace {

using Slab = openvdb::MaskTree::Ptr;

// Slabs are smaller than the largest part, so that reading the parts takes the most memory, but some nodes
// large.
constexpr double kSlabShare = 0.5;
constexpr std::size_t kLeastSlabBytes = std::size_t{16} << 20;

// The voxels of a density that are left when those below its least are left out, which shows by their values.
class PrunedVoxels final : public VoxelSource {
 public:
  PrunedVoxels(std::shared_ptr<const PartsGrid> grid, const SlabDensity& density)
      : grid_(std::move(grid)), density_(density) {
    for (std::size_t i = 0; i < grid_->nodes().size(); ++i) {
      const Slab left = pruned(i, i + 1);
      if (left->leafCount() == 0) continue;
      nodes_.push_back({grid_->nodes()[i].origin, left->leafCount()});
      sources_.push_back(i);
      active_ += left->activeVoxelCount();
      openvdb::CoordBBox bounds;
      left->evalActiveVoxelBoundingBox(bounds);
      bounds_.expand(bounds);
    }
  }

  const std::vector<Node>& nodes() const override { return nodes_; }
  openvdb::Index64 active_voxels() const override { return active_; }
  openvdb::CoordBBox active_bounds() const override { return bounds_; }
  Slab voxels(std::size_t first, std::size_t end) const override {
    auto mask = std::make_shared<openvdb::MaskTree>(false);
    for (std::size_t i = first; i < end; ++i) mask->merge(*pruned(sources_[i], sources_[i] + 1));
    return mask;
  }

 private:
  Slab pruned(std::size_t first, std::size_t end) const {
    const auto values = grid_->values<openvdb::FloatGrid>(*grid_->voxels(first, end));
    density_.scale(*values);
    density_.prune(*values);
    return std::make_shared<openvdb::MaskTree>(values->tree(), false, openvdb::TopologyCopy());
  }

  std::shared_ptr<const PartsGrid> grid_;
  const SlabDensity& density_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> sources_;  // of each node, that of the grid
  openvdb::Index64 active_ = 0;
  openvdb::CoordBBox bounds_;
};

// One grid of the volume.
struct MergedGrid {
  OutputGrid output;
  openvdb::GridBase::Ptr header;  // of the first part
  std::shared_ptr<PartsGrid> parts;
  std::optional<SlabDensity> density{};
};

class PartsStream {
 public:
  PartsStream(const std::vector<std::filesystem::path>& files, const std::filesystem::path& path,
              VdbWriteOptions options)
      : path_(path), options_(std::move(options)), readers_(files) {
    read_parts(files);
    options_.codec = merged_.recipe.codec;
    options_.frame = merged_.frame;
    options_.fps = merged_.fps;
  }

  MergedVolume run() {
    for (MergedGrid& grid : grids_) settle(grid);
    for (std::size_t i = 0; i < grids_.size(); ++i) merged_.volume.grids.push_back(make_grid(i));
    write_volume(path_, merged_.volume, options_);
    return std::move(merged_);
  }

 private:
  // All of each, one after the other: whether they are what was written, and where their nodes are.
  void read_parts(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) throw std::runtime_error("there are no parts to merge");
    std::optional<PartFile> first;
    Census joined;
    std::size_t largest = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
      throw_if_cancelled(options_.progress);
      if (options_.progress != nullptr) options_.progress->advance(i, 2 * files.size());
      PartFile part = read_part(files[i]);
      if (first) require_same_volume(part, *first);
      joined.add(part.own);
      if (!first) begin(part);
      for (std::size_t grid = 0; grid < grids_.size(); ++grid) {
        const openvdb::GridBase& of_part = *part.file.grids[grid];
        if (of_part.type() != grids_[grid].header->type()) {
          refuse(part, "has grids of other types than the other parts");
        }
        grids_[grid].parts->add_part(i, of_part);
        largest = std::max(largest, of_part.baseTree().leafCount() * bytes_of_leaf(of_part));
      }
      if (first) continue;
      for (openvdb::GridBase::Ptr& grid : part.file.grids) grid->newTree();
      first = std::move(part);
    }
    require_complete(joined, first->whole);
    for (MergedGrid& grid : grids_) grid.parts->finish();
    slab_bytes_ = std::clamp(static_cast<std::size_t>(kSlabShare * static_cast<double>(largest)),
                             kLeastSlabBytes, kSlabBytes);
  }

  static std::size_t bytes_of_leaf(const openvdb::GridBase& grid) {
    constexpr std::size_t kVoxels = openvdb::FloatTree::LeafNodeType::SIZE;
    return kVoxels * (grid.isType<openvdb::Vec3SGrid>() ? sizeof(openvdb::Vec3s) : sizeof(float));
  }

  void begin(const PartFile& part) {
    take_description(part, merged_);
    std::vector<OutputGrid> outputs = output_grids(merged_.recipe);
    if (outputs.size() != part.file.grids.size()) refuse(part, "has other grids than its recipe");
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const openvdb::GridBase& grid = *part.file.grids[i];
      if (!grid.isType<openvdb::FloatGrid>() && !grid.isType<openvdb::Vec3SGrid>()) {
        refuse(part, fmt::format("has a grid of type {}, which no part has", grid.valueType()));
      }
      openvdb::GridBase::Ptr header = grid.copyGridWithNewTree();
      header->clearMetadata();
      grids_.push_back({std::move(outputs[i]), std::move(header), std::make_shared<PartsGrid>(readers_, i)});
    }
  }

  // Finds how a density is scaled.
  void settle(MergedGrid& grid) {
    if (!grid.output.is_density()) return;
    grid.density.emplace(grid.output.single, grid.parts->active_bounds());
    if (grid.density->has_unknowns()) {
      visit_slabs(*grid.parts, 1, slab_bytes_, [&](const Slab& slab) {
        throw_if_cancelled(options_.progress);
        const auto values = grid.parts->values<openvdb::FloatGrid>(*slab);
        grid.density->look(*values, measure(*values).max());
      });
    }
    grid.density->settle(grid.header->transform());
  }

  MeasuredGrid make_grid(std::size_t i) {
    const MergedGrid& of = grids_[i];
    const int components = of.header->isType<openvdb::FloatGrid>() ? 1 : 3;
    std::shared_ptr<const VoxelSource> voxels = of.parts;
    if (of.density && of.density->prunes()) voxels = std::make_shared<PrunedVoxels>(of.parts, *of.density);
    const auto grid = make_streamed_grid(
        components, voxels, [this, i](const Slab& slab) { return values(i, *slab); }, slab_bytes_);
    grid->setTransform(of.header->transformPtr());
    MeasuredGrid measured{grid, std::vector<Moments>(static_cast<std::size_t>(components))};
    if (of.density) note_density_factor(of.density->factor(), *grid);
    name_grid(of.output, options_.creator, *grid);
    note_recipe(merged_.recipe, measured.moments, *grid);
    return measured;
  }

  // Of a slab that is to be written; notes what is known of all until then.
  openvdb::GridBase::Ptr values(std::size_t i, const openvdb::MaskTree& slab) {
    const MergedGrid& of = grids_[i];
    openvdb::GridBase::Ptr grid;
    if (of.header->isType<openvdb::Vec3SGrid>()) {
      grid = of.parts->values<openvdb::Vec3SGrid>(slab);
    } else {
      const auto floats = of.parts->values<openvdb::FloatGrid>(slab);
      if (of.density) {
        of.density->scale(*floats);
        of.density->prune(*floats);
      }
      grid = floats;
    }
    finish_slab(path_, merged_.recipe, of.output, *grid, merged_.volume.grids[i]);
    return grid;
  }

  const std::filesystem::path path_;
  VdbWriteOptions options_;
  PartReaders readers_;
  std::vector<MergedGrid> grids_;
  std::size_t slab_bytes_ = kSlabBytes;
  MergedVolume merged_;
};

}  // namespace

MergedVolume merge_parts_to_file(const std::vector<std::filesystem::path>& files,
                                 const std::filesystem::path& path, VdbWriteOptions options) {
  return PartsStream(files, path, std::move(options)).run();
}

bool may_stream_parts(const std::vector<std::filesystem::path>& files) {
  return std::ranges::all_of(files, [](const std::filesystem::path& file) {
    try {
      return VdbReader(file).has_offsets();
    } catch (const std::exception&) {
      return false;  // what is wrong with it shows where it is read
    }
  });
}

}  // namespace solidnoise
