#include "vdbnoise/parameter_flags.h"

#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "common/noise_flags.h"
#include "common/usage_error.h"
#include "vdbnoise/grid_flags.h"

namespace solidnoise {
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

}  // namespace solidnoise
