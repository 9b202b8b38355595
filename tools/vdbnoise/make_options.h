#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/flag_set.h"
#include "common/progress.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What the command line of `vdbnoise --out FILE` says, beside the recipe.
struct MakeOptions {
  enum class Task { make, describe, list_presets };

  Task task = Task::make;
  VolumeRecipe recipe;
  std::string out;                             // .vdb, "-" for the standard output; empty: none
  std::string preview;                         // .png; empty: none
  openvdb::FloatGrid::ConstPtr preview_frame;  // by whose voxels previews are framed; null: by their own
  std::string write_recipe;                    // .json, "-" for the standard output; empty: none
  Existing existing = Existing::refuse;
  bool skip_existing = false;    // of volumes that are what would be made
  int threads = 0;               // 0: as many as the machine has
  std::uint64_t max_memory = 0;  // bytes; 0: what the machine has available
  double max_time = 0.0;         // seconds; 0: any
  bool quiet = false;
  bool timings = false;
  std::shared_ptr<StageTimes> times = std::make_shared<StageTimes>();  // of all frames

  std::vector<int> frames;  // of a sequence; empty: one volume
  double fps = 24.0;        // frames per unit of time
  VolumePart part;          // what of the volume to make

  // Of one frame of a sequence:
  std::optional<int> frame;
  std::string task_prefix;  // before the names of tasks in the progress bar
  bool warns = true;        // of what holds for all frames
};

// Declares all flags. Before they are applied the caller puts the recipe that they override into `options`:
// --preset, --recipe and --raw choose it.
void declare_make_flags(FlagSet& flags, MakeOptions& options);

// Refuses what the flags leave without effect. Throws UsageError.
void check_make_options(const FlagSet& flags, const MakeOptions& options);

// Declares --frames and --fps, and --shard and --region.
void declare_sequence_flags(FlagSet& flags, MakeOptions& options);

// Refuses frames that would all be the same, that have no place in the outputs' names, or that do not fit the
// recipe's loop; and parts of what cannot be cut. Throws UsageError.
void check_sequence(const FlagSet& flags, const MakeOptions& options);

// Whether the frames are densities that are all to be scaled by one factor, which is still to be measured.
bool shares_density_factor(const MakeOptions& options);
// Whether they are scaled one by one instead, since each has an input of its own: there is no first among
// them that would be the same whichever frames are asked for.
bool scales_each_frame(const MakeOptions& options);

// What is to be made for one of the frames: names with its number, and its moment. The moment of frame n is
// the recipe's own plus n / fps; frames that are a loop apart have the same.
MakeOptions options_of_frame(const MakeOptions& options, std::size_t index);

}  // namespace solidnoise
