#include "solidnoise/volume/stream_volume.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/shape_cover.h"
#include "solidnoise/volume/slab_density.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

using MaskLeaf = openvdb::MaskTree::LeafNodeType;

// Adds the leaves of a grid, with its active voxels.
void add_voxels(const openvdb::GridBase& grid, openvdb::MaskTree& mask) {
  using Filled = openvdb::TypeList<openvdb::FloatGrid, openvdb::Vec3SGrid>;
  grid.apply<Filled>([&](const auto& typed) {
    for (auto leaf = typed.tree().cbeginLeaf(); leaf; ++leaf) {
      auto voxels = std::make_unique<MaskLeaf>(openvdb::PartialCreate(), leaf->origin(), false, false);
      voxels->setValueMask(leaf->valueMask());
      mask.addLeaf(voxels.release());
    }
  });
}

// One grid of the volume.
struct Part {
  OutputGrid output;
  GridChannels channels;
  std::shared_ptr<openvdb::MaskTree> mask{};  // its active voxels
  std::optional<SlabDensity> density{};
};

class VolumeStream {
 public:
  VolumeStream(const std::filesystem::path& path, const VolumeRecipe& recipe, const VolumePlan& plan,
               const VdbWriteOptions& options, std::size_t slab_bytes)
      : path_(path),
        recipe_(with_digests(recipe, plan)),
        options_(options),
        slab_bytes_(slab_bytes),
        passes_(passes_of_stream(recipe)) {
    auto [topology, cover] = make_shape(recipe, plan, options.progress);
    if (plan.parameters) plan.parameters->require_allowed_at(topology);
    topology_ = std::move(topology);
    VolumeField field = make_volume_field(recipe, plan, cover);
    field_ = std::move(field.field);
    for (OutputGrid& output : output_grids(recipe_)) {
      parts_.push_back({std::move(output), field.grids[parts_.size()]});
    }
  }

  Volume run() {
    find_voxels();
    topology_.mask.reset();
    for (std::size_t i = 0; i < parts_.size(); ++i) volume_.grids.push_back(make_grid(i));
    write_volume(path_, volume_, options_);
    return std::move(volume_);
  }

 private:
  using Slab = openvdb::MaskTree::Ptr;

  void find_voxels() {
    std::vector<Part*> sparse;
    std::vector<Part*> pruned;
    for (Part& part : parts_) {
      part.mask = topology_.mask;
      if (part.output.is_density()) part.density.emplace(part.output.single, topology_.voxel_bounds());
      if (part.channels.sparsity == Sparsity::keep) continue;
      part.mask = std::make_shared<openvdb::MaskTree>(false);
      sparse.push_back(&part);
      if (part.density && part.density->prunes()) pruned.push_back(&part);
    }
    survey(sparse, [](Part& part, const MeasuredGrid& found) {
      if (!part.density || !part.density->prunes()) add_voxels(*found.grid, *part.mask);
      if (!part.density || found.moments.front().count() == 0) return;
      part.density->look(dynamic_cast<const openvdb::FloatGrid&>(*found.grid), found.moments.front().max());
    });
    for (Part& part : parts_) {
      if (part.density) part.density->settle(*topology_.frame.transform());
    }
    survey(pruned, [](Part& part, const MeasuredGrid& found) {
      auto& density = dynamic_cast<openvdb::FloatGrid&>(*found.grid);
      part.density->scale(density);
      part.density->prune(density);
      add_voxels(density, *part.mask);
    });
  }

  // Shows what all voxels of the shape are, slab by slab, to each of the parts.
  template <typename Visit>
  void survey(const std::vector<Part*>& parts, const Visit& visit) {
    if (parts.empty()) return;
    std::vector<GridChannels> channels;
    int components = 0;
    for (const Part* part : parts) {
      channels.push_back(part->channels);
      components += part->channels.count;
    }
    visit_slabs(MaskVoxels(topology_.mask), components, slab_bytes_, [&](const Slab& slab) {
      const std::vector<MeasuredGrid> filled = fill(slab, channels, *topology_.mask);
      for (std::size_t i = 0; i < parts.size(); ++i) visit(*parts[i], filled[i]);
    });
  }

  MeasuredGrid make_grid(std::size_t i) {
    const Part& part = parts_[i];
    const auto grid = make_streamed_grid(
        part.channels.count, std::make_shared<MaskVoxels>(part.mask),
        [this, i](const Slab& slab) { return values(i, slab); }, slab_bytes_);
    grid->setTransform(topology_.frame.transform());
    MeasuredGrid measured{grid, std::vector<Moments>(static_cast<std::size_t>(part.channels.count))};
    if (part.density) note_density_factor(part.density->factor(), *grid);
    name_grid(part.output, options_.creator, *grid);
    note_recipe(recipe_, measured.moments, *grid);
    return measured;
  }

  // Of a slab that is to be written; notes what is known of all until then.
  openvdb::GridBase::Ptr values(std::size_t i, const Slab& slab) {
    const Part& part = parts_[i];
    MeasuredGrid& measured = volume_.grids[i];
    const openvdb::GridBase::Ptr grid =
        fill(slab, {{part.channels.first, part.channels.count, Sparsity::keep}}, *part.mask).front().grid;
    if (part.density) part.density->scale(dynamic_cast<openvdb::FloatGrid&>(*grid));
    finish_slab(path_, recipe_, part.output, *grid, measured);
    return grid;
  }

  std::vector<MeasuredGrid> fill(const Slab& slab, const std::vector<GridChannels>& channels,
                                 const openvdb::MaskTree& whole) {
    const double share = static_cast<double>(slab->leafCount()) / whole.leafCount() / passes_;
    PartialProgress progress(options_.progress, done_, done_ + share);
    done_ += share;
    return fill_grids({topology_.frame, slab}, *field_, channels, &progress);
  }

  const std::filesystem::path path_;
  const VolumeRecipe recipe_;
  const VdbWriteOptions options_;
  const std::size_t slab_bytes_;
  const int passes_;
  Topology topology_{GridFrame(1.0), nullptr};  // of the shape; its mask until the voxels are found
  FieldPtr field_;
  std::vector<Part> parts_;
  Volume volume_;
  double done_ = 0.0;  // of all passes
};

}  // namespace

bool may_stream(const VolumePlan& plan) {
  return plan.part.whole() && !plan.modification;
}

int passes_of_stream(const VolumeRecipe& recipe) {
  const std::vector<OutputGrid> outputs = output_grids(recipe);
  const bool sparse =
      std::ranges::any_of(outputs, [](const OutputGrid& output) { return !keeps_all_voxels(output.single); });
  const bool pruned = std::ranges::any_of(
      outputs, [](const OutputGrid& output) { return output.is_density() && output.single.prune > 0.0; });
  return static_cast<int>(outputs.size()) + (sparse ? 1 : 0) + (pruned ? 1 : 0);
}

Volume stream_volume(const std::filesystem::path& path, const VolumeRecipe& recipe, const VolumePlan& plan,
                     const VdbWriteOptions& options, std::size_t slab_bytes) {
  return VolumeStream(path, recipe, plan, options, slab_bytes).run();
}

}  // namespace solidnoise
