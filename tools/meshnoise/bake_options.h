#pragma once

#include <string>
#include <vector>

#include "common/flag_set.h"
#include "common/run_options.h"
#include "meshnoise/mesh_files.h"
#include "solidnoise/mesh/bake_recipe.h"
#include "solidnoise/mesh/texture_plan.h"

namespace solidnoise {

// What the command line of `meshnoise bake` says, beside the recipe.
struct BakeOptions : RunOptions {
  BakeRecipe recipe;
  std::string out;   // of any MeshFormat; "-" for a .ply on the standard output; empty: none
  bool usd = false;  // and as a .usda beside it
  std::string uv;    // of textures, with <UDIM> or <MAP> where they are several; empty: none
  std::vector<std::string> maps{"color"};  // that are baked into textures
  TextureOptions textures;
  std::string preview;  // .png; empty: none
  MeshView view;
  std::string write_recipe;       // .json, "-" for the standard output; empty: none
  std::vector<std::string> keep;  // names of numbers that the mesh shall have
  std::string rest;               // the mesh whose vertices say where the noise is; empty: the mesh itself
  std::string rest_property;      // the number of the vertices that says so instead; empty: none
  std::vector<int> frames;        // of a sequence; empty: one mesh
  double fps = 24.0;              // frames per unit of time

  bool has_rest() const { return !rest.empty() || !rest_property.empty(); }
};

// Declares all flags. Before they are applied the caller puts the recipe that they override into `options`:
// --preset and --recipe choose it.
void declare_bake_flags(FlagSet& flags, BakeOptions& options);

}  // namespace solidnoise
