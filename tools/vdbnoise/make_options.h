#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/flag_set.h"
#include "common/recipe_files.h"
#include "common/run_options.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "solidnoise/volume/vdb/nvdb_write.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

// What the command line of `vdbnoise --out FILE` says, beside the recipe.
struct MakeOptions : RunOptions {
  VolumeRecipe recipe;
  std::string out;   // .vdb or .nvdb, "-" for the standard output; empty: none
  bool usd = false;  // and a scene beside it
  NvdbValues nvdb_values = NvdbValues::floats;
  std::string preview;                         // .png; empty: none
  std::optional<GridFile> frame_source;        // by whose voxels previews are framed; none: by their own
  openvdb::FloatGrid::ConstPtr preview_frame;  // as it is read
  std::string write_recipe;                    // .json, "-" for the standard output; empty: none
  bool skip_existing = false;                  // of volumes that are what would be made
  RecipeInputs inputs;

  std::vector<int> frames;                           // of a sequence; empty: one volume
  double fps = 24.0;                                 // frames per unit of time
  std::function<VolumeRecipe(int frame)> recipe_at;  // of each frame, where flags are curves; null: `recipe`
  VolumePart part;                                   // what of the volume to make

  // Of one frame of a sequence:
  std::optional<int> frame;
  std::string task_prefix;  // before the names of tasks in the progress bar
  bool warns = true;        // of what holds for all frames
};

// Declares all flags, and returns those of the noise. Before they are applied the caller puts the recipe that
// they override into `options`.
std::vector<std::string> declare_make_flags(FlagSet& flags, MakeOptions& options);

// Refuses what the flags leave without effect. Throws UsageError.
void check_make_options(const FlagSet& flags, const MakeOptions& options,
                        const std::vector<std::string>& noise_flags);

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
