#include "vdbnoise/grid_flags.h"

#include <array>
#include <filesystem>
#include <variant>

#include <fmt/format.h>

#include "common/field_flags.h"
#include "common/noise_flags.h"
#include "common/parse_value.h"
#include "common/run_tool.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/volume/modify/modification.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise {

GridFile FlagForm<GridFile>::read(const std::string& flag, const std::vector<std::string>& texts) {
  std::optional<GridFile> source = parse_grid_file(texts[0]);
  if (!source) refuse_value(flag, texts[0], "FILE.vdb or FILE.vdb:GRID, or - for the standard input");
  if (source->file != "-") source->file = std::filesystem::absolute(source->file).string();
  return *source;
}

std::string FlagForm<GridFile>::write(const GridFile& source) {
  return source.grid.empty() ? source.file : source.file + ':' + source.grid;
}

Shape FlagForm<Shape>::read(const std::string& flag, const std::vector<std::string>& texts) {
  const std::string& text = texts[0];
  if (text == "box") return BoxShape{};
  if (text == "sphere") return SphereShape{};
  if (text == "ellipsoid") return EllipsoidShape{};
  if (is_mesh_path(text)) return MeshShape{std::filesystem::absolute(text).string()};
  if (parse_grid_file(text)) return FlagForm<GridFile>::read(flag, texts);
  refuse_value(flag, text,
               "box, sphere, ellipsoid, FILE.obj (or .ply, .off, .stl, .om), FILE.vdb or FILE.vdb:GRID");
}

std::string FlagForm<Shape>::write(const Shape& shape) {
  constexpr std::array kWords{"box", "sphere", "ellipsoid", "", ""};
  return kWords[shape.index()];
}

namespace {

void declare_parameter(FlagSet& flags, const std::string& name, ParameterGrids& grids,
                       std::optional<ParameterGrid>& grid) {
  static const ParameterGrid kNone{};
  const std::string grid_flag = "--" + name + "-grid";
  const std::string map_flag = "--" + name + "-map";
  declare_field(flags, grids, name + "_grid", [&grid](const std::optional<ParameterGrid>& given) {
    grid = ParameterGrid{given->source, grid ? grid->map : std::nullopt};
  });
  declare_field(flags, kNone, "map", {map_flag, "With " + grid_flag + ": "},
                [&grid, grid_flag, map_flag](const std::optional<ValueMap>& map) {
                  if (!grid) {
                    throw UsageError(fmt::format("{} has no effect without {}", map_flag, grid_flag));
                  }
                  grid->map = map;
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
  ParameterGrids& grids = recipe.parameters;
  flags.group("Parameters that vary in space, from grids");
  declare_parameter(flags, "frequency", grids, grids.frequency);
  declare_parameter(flags, "bandwidth", grids, grids.bandwidth);
  declare_parameter(flags, "magnitude", grids, grids.magnitude);
  declare_field(flags, grids, "direction_grid", [&](const std::optional<GridFile>& grid) {
    grids.direction = grid;
    give_direction(flags, recipe.noise);
  });
}

void check_parameter_flags(const FlagSet& flags, const VolumeRecipe& recipe) {
  const ParameterGrids& parameters = recipe.parameters;
  const auto refuse = [&](std::initializer_list<std::string_view> constants, const char* grid_flag) {
    flags.refuse(constants, fmt::format("has no effect where {} says it for each voxel", grid_flag));
  };
  // The lobes of a cloud have a size, whatever the noise on them.
  const bool is_cloud = std::holds_alternative<CloudShaping>(recipe.shaping);
  if (parameters.frequency && !is_cloud) refuse({"--frequency", "--size"}, "--frequency-grid");
  if (parameters.bandwidth) refuse({"--bandwidth"}, "--bandwidth-grid");
  if (parameters.direction) refuse({"--direction"}, "--direction-grid");
}

void declare_modify_flags(FlagSet& flags, VolumeRecipe& recipe) {
  flags.group("Grids that exist (with --on)");
  static const Modification kStandard{};
  const auto declare = [&](std::string_view name, auto Modification::*member) {
    using Value = std::remove_cvref_t<decltype(kStandard.*member)>;
    declare_field(flags, kStandard, name, [&recipe, member](const Value& value) {
      if (!recipe.modification) recipe.modification.emplace();
      Modification& modification = *recipe.modification;
      if constexpr (std::same_as<Value, Combine>) modification.displace.reset();
      if constexpr (std::same_as<Value, std::optional<double>>) {
        modification.combine = kStandard.combine;
        modification.amount = kStandard.amount;
      }
      modification.*member = value;
    });
  };
  declare("on", &Modification::on);
  declare("combine", &Modification::combine);
  declare("amount", &Modification::amount);
  declare("displace", &Modification::displace);
  declare("mask", &Modification::mask);
  declare("rest", &Modification::rest);
  flags.exclude({"--combine", "--displace"});
  flags.exclude({"--amount", "--displace"});
  flags.exclude({"--on", "--shape"});
}

void check_modify_flags(const FlagSet& flags, const VolumeRecipe& recipe) {
  if (!recipe.modification) return;
  if (recipe.modification->on.file.empty()) {
    flags.refuse({"--combine", "--amount", "--displace", "--mask", "--rest"},
                 "has no effect without --on FILE.vdb, the grid to work on");
    throw UsageError(
        "--on is missing; the recipe works on a grid that exists: --on FILE.vdb or FILE.vdb:GRID");
  }
  flags.refuse({"--shape", "--box", "--voxel", "--dim", "--edge", "--edge-voxels", "--prune"},
               "has no effect with --on, whose voxels are kept");
  flags.refuse({"--grid"}, "has no effect with --on, whose name is kept; --on FILE.vdb:GRID chooses one");
  const Modification& modification = *recipe.modification;
  if (modification.displace) {
    flags.refuse({"--amount"}, "has no effect where the recipe displaces; --displace UNITS says how far");
    return flags.refuse({"--optical-depth", "--density"}, "has no effect on a level set that is displaced");
  }
  if (modification.combine == Combine::replace) {
    return flags.refuse({"--amount"}, "has no effect with --combine replace");
  }
  flags.refuse({"--optical-depth", "--density"},
               "has no effect on a grid that exists, unless --combine replace makes all of it");
  if (modification.combine == Combine::erode) {
    flags.refuse({"--range"}, "has no effect with --combine erode, which takes noise from 0 to 1");
  }
}

}  // namespace solidnoise
