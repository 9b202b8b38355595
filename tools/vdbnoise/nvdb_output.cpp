#include "vdbnoise/nvdb_output.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>

#include <fmt/format.h>

#include "solidnoise/core/extension.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise {
namespace {

int bits_of(NvdbValues values) {
  constexpr int kBits[] = {32, 16, 8, 4};
  return kBits[static_cast<std::size_t>(values)];
}

// A bound in three digits, the last one rounded up.
std::string round_up(double bound) {
  constexpr int kDigits = 3;
  if (bound == 0.0) return "0";
  const double last = std::pow(10.0, std::floor(std::log10(bound)) - (kDigits - 1));
  return fmt::format("{:.3g}", std::ceil(bound / last) * last);
}

}  // namespace

bool is_nvdb(const MakeOptions& options) {
  return extension_of(options.out) == ".nvdb";
}

void check_format(const FlagSet& flags, const MakeOptions& options) {
  if (!is_nvdb(options)) return flags.refuse({"--nvdb-bits"}, "is of --out FILE.nvdb");
  flags.refuse({"--half", "--codec"}, "is of .vdb; --nvdb-bits says how a .nvdb stores values");
  flags.refuse({"--skip-existing", "--shard", "--region"},
               "needs the recipe in the file, which a .nvdb has no place for; give --out FILE.vdb");
}

double nvdb_bytes(const VolumeRecipe& recipe, const VolumePlan& plan) {
  constexpr double kMasksAndStatistics = 1.1;  // of leaves: 96 bytes beside 2048
  double floats = 0.0;
  for (const VolumeRecipe& single : recipes_of_grids(recipe)) {
    for (const int components : components_of(single.output)) floats += components;
  }
  return kMasksAndStatistics * sizeof(float) * floats * static_cast<double>(plan.voxels.volume());
}

void print_nvdb_errors(const MakeOptions& options, const Volume& volume, const std::vector<double>& errors) {
  const openvdb::GridCPtrVec grids = grids_of(volume);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (options.nvdb_values == NvdbValues::floats || !has_floats(*grids[i])) continue;
    std::cerr << fmt::format("{}: grid {}, in {} bits: stored values are within {} of what was made\n",
                             options.out, grids[i]->getName(), bits_of(options.nvdb_values),
                             round_up(errors[i]));
  }
  if (options.write_recipe.empty()) {
    std::cerr << options.out << ": has no place for the recipe; --write-recipe FILE.json keeps it\n";
  }
}

}  // namespace solidnoise
