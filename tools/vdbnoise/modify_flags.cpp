#include "vdbnoise/modify_flags.h"

#include <fmt/format.h>

#include "common/usage_error.h"
#include "solidnoise/volume/modify/modification_json.h"
#include "vdbnoise/grid_flags.h"

namespace solidnoise {
namespace {

Modification& modification_of(VolumeRecipe& recipe) {
  return recipe.modification ? *recipe.modification : recipe.modification.emplace();
}

void refuse(const FlagSet& flags, const char* flag, const char* why) {
  if (flags.given(flag)) throw UsageError(fmt::format("{} has no effect {}", flag, why));
}

}  // namespace

void declare_modify_flags(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Grids that exist");
  const auto grid_file = [&](const std::string& flag, const std::string& help, const auto& keep_in) {
    flags.text(flag, "FILE.vdb[:GRID]", help, [flag, keep_in, &recipe](const std::string& text) {
      keep_in(modification_of(recipe), parse_grid_flag(flag, text));
    });
  };
  grid_file("--on", "Work on the active voxels of this grid; all else in its file is kept",
            [](Modification& modification, const GridFile& source) { modification.on = source; });
  flags.choice(
      "--combine", names_of(kCombineChoices),
      "With --on: noise n in place of value v; v + a n; v (1 + a n); or wear thin parts off (default "
      "multiply)",
      [&recipe](std::size_t index) {
        modification_of(recipe).combine = kCombineChoices[index].value;
        modification_of(recipe).displace.reset();
      });
  flags.number("--amount", "FACTOR", "With --on: the factor a (default 0.5)",
               [&recipe](double value) { modification_of(recipe).amount = value; });
  flags.number("--displace", "UNITS",
               "With --on, of a level set: move its surface along its normals, world units for one sigma",
               [&recipe](double value) {
                 modification_of(recipe) = {.on = modification_of(recipe).on,
                                            .displace = value,
                                            .mask = modification_of(recipe).mask,
                                            .rest = modification_of(recipe).rest};
               });
  grid_file("--mask",
            "With --on: limit the change to where this is over 0 (floats, level set, bools or mask)",
            [](Modification& modification, const GridFile& source) { modification.mask = source; });
  grid_file("--rest",
            "With --on: look the noise up at these rest positions (vec3s or vec3d), not at the voxels",
            [](Modification& modification, const GridFile& source) { modification.rest = source; });
  flags.exclude({"--combine", "--displace"});
  flags.exclude({"--amount", "--displace"});
  flags.exclude({"--on", "--shape"});
}

void check_modify_flags(const FlagSet& flags, const VolumeRecipe& recipe) {
  if (!recipe.modification) return;
  if (recipe.modification->on.file.empty()) {
    for (const char* flag : {"--combine", "--amount", "--displace", "--mask", "--rest"}) {
      refuse(flags, flag, "without --on FILE.vdb, the grid to work on");
    }
    throw UsageError(
        "--on is missing; the recipe works on a grid that exists: --on FILE.vdb or FILE.vdb:GRID");
  }
  for (const char* flag : {"--shape", "--box", "--voxel", "--dim"}) {
    refuse(flags, flag, "with --on, whose voxels are kept");
  }
  refuse(flags, "--grid", "with --on, whose name is kept; --on FILE.vdb:GRID chooses one");
  const Modification& modification = *recipe.modification;
  if (modification.displace)
    refuse(flags, "--amount", "where the recipe displaces; --displace UNITS says how far");
  const bool replaces = !modification.displace && modification.combine == Combine::replace;
  if (replaces) refuse(flags, "--amount", "with --combine replace");
  for (const char* flag : {"--optical-depth", "--density"}) {
    if (!replaces) refuse(flags, flag, "on a grid that exists, unless --combine replace makes all of it");
  }
  const bool erodes = !modification.displace && modification.combine == Combine::erode;
  if (erodes) refuse(flags, "--range", "with --combine erode, which takes noise from 0 to 1");
}

}  // namespace solidnoise
