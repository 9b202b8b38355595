#include "vdbnoise/grid_flags.h"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "common/field_flags.h"
#include "common/run_tool.h"
#include "solidnoise/volume/modify/modification.h"

namespace solidnoise {

GridFile parse_grid_flag(const std::string& flag, const std::string& text) {
  std::optional<GridFile> source = parse_grid_file(text);
  if (!source) {
    throw UsageError(
        fmt::format("{} is {}; it must be FILE.vdb or FILE.vdb:GRID", flag, text.empty() ? "empty" : text));
  }
  source->file = std::filesystem::absolute(source->file).string();
  return *source;
}

void declare_grid_file(FlagSet& flags, const std::string& flag, const std::string& help,
                       std::optional<GridFile>& target) {
  flags.text(flag, "FILE.vdb[:GRID]", help,
             [flag, &target](const std::string& text) { target = parse_grid_flag(flag, text); });
}

namespace {

// Texts of the help.
struct Help {
  const char* grid;
  const char* map;
};

void declare_parameter(FlagSet& flags, const std::string& name, const Help& help,
                       std::optional<ParameterGrid>& grid) {
  const std::string grid_flag = "--" + name + "-grid";
  const std::string map_flag = "--" + name + "-map";
  flags.text(grid_flag, "FILE.vdb[:GRID]", help.grid, [&grid, grid_flag](const std::string& text) {
    const GridFile source = parse_grid_flag(grid_flag, text);
    if (!grid) grid.emplace();
    grid->source = source;
  });
  flags.numbers(map_flag, "LOW HIGH A B", 4, help.map,
                [&grid, grid_flag, map_flag](const std::vector<double>& v) {
                  if (!grid) {
                    throw UsageError(fmt::format("{} has no effect without {}", map_flag, grid_flag));
                  }
                  grid->map = ValueMap{v[0], v[1], v[2], v[3]};
                });
}

// Waves that have a direction, unless the flags ask for others.
void give_direction(const FlagSet& flags, NoiseRecipe& noise) {
  if (!flags.given("--noise") && std::holds_alternative<GaborNoiseOptions>(noise.noise)) {
    change_noise_type(noise, "gabor-oriented");
  }
  auto* const oriented = std::get_if<OrientedGaborNoiseOptions>(&noise.noise);
  if (oriented && !flags.given("--anisotropy")) oriented->anisotropy = 1.0;
}

}  // namespace

void declare_parameter_flags(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Parameters that vary in space, from grids");
  declare_parameter(flags, "frequency",
                    {"Gabor noises: frequency at each voxel (floats), cycles per world unit",
                     "Values LOW and HIGH of that grid mean A and B; between, in equal ratios"},
                    recipe.parameters.frequency);
  declare_parameter(flags, "bandwidth",
                    {"Gabor noises: bandwidth at each voxel (floats), 0.1 to 4 octaves",
                     "Values LOW and HIGH of that grid mean A and B; between, linear"},
                    recipe.parameters.bandwidth);
  declare_parameter(flags, "magnitude",
                    {"Standard deviation at each voxel (floats), in sigmas of the noise",
                     "Values LOW and HIGH of that grid mean A and B; between, linear"},
                    recipe.parameters.magnitude);
  flags.text("--direction-grid", "FILE.vdb[:GRID]",
             "Where the waves travel at each voxel (vec3s or vec3d), of gabor-oriented noise of anisotropy 1",
             [&](const std::string& text) {
               recipe.parameters.direction = parse_grid_flag("--direction-grid", text);
               give_direction(flags, recipe.noise);
             });
}

void check_parameter_flags(const FlagSet& flags, const VolumeRecipe& recipe) {
  const ParameterGrids& parameters = recipe.parameters;
  const auto refuse = [&](bool varies, const char* flag, const char* grid_flag) {
    if (varies && flags.given(flag)) {
      throw UsageError(fmt::format("{} has no effect where {} says it for each voxel", flag, grid_flag));
    }
  };
  // The lobes of a cloud have a size, whatever the noise on them.
  const bool is_cloud = std::holds_alternative<CloudShaping>(recipe.shaping);
  refuse(parameters.frequency && !is_cloud, "--frequency", "--frequency-grid");
  refuse(parameters.frequency && !is_cloud, "--size", "--frequency-grid");
  refuse(parameters.bandwidth.has_value(), "--bandwidth", "--bandwidth-grid");
  refuse(parameters.direction.has_value(), "--direction", "--direction-grid");
}

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
  for (const char* flag : {"--shape", "--box", "--voxel", "--dim", "--edge", "--prune"}) {
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
