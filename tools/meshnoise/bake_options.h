#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/flag_set.h"
#include "common/progress.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/mesh/bake_recipe.h"

namespace solidnoise {

// What the command line of `meshnoise bake` says, beside the recipe.
struct BakeOptions {
  enum class Task { bake, describe, list_presets };

  Task task = Task::bake;
  BakeRecipe recipe;
  std::string out;      // .ply, .obj, .off, .stl or .om; "-" for a .ply on the standard output; empty: none
  std::string preview;  // .png; empty: none
  std::string write_recipe;       // .json, "-" for the standard output; empty: none
  std::vector<std::string> keep;  // names of numbers that the mesh shall have
  Existing existing = Existing::refuse;
  int threads = 0;               // 0: as many as the machine has
  std::uint64_t max_memory = 0;  // bytes; 0: what the machine has available
  double max_time = 0.0;         // seconds; 0: any
  bool quiet = false;
  bool timings = false;
  std::shared_ptr<StageTimes> times = std::make_shared<StageTimes>();
};

// Declares all flags. Before they are applied the caller puts the recipe that they override into `options`:
// --preset and --recipe choose it.
void declare_bake_flags(FlagSet& flags, BakeOptions& options);

}  // namespace solidnoise
