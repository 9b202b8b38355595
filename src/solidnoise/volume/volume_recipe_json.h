#pragma once

#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "solidnoise/core/bounds.h"
#include "solidnoise/core/fields.h"
#include "solidnoise/field/field_tables.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise {

inline constexpr Choices<Codec, 3> kCodecChoices{{
    {Codec::blosc, "blosc"},
    {Codec::zip, "zip"},
    {Codec::none, "none"},
}};

inline constexpr Choices<PreviewLook, 6> kLookChoices{{
    {PreviewLook::automatic, "auto"},
    {PreviewLook::cloud, "cloud"},
    {PreviewLook::smoke, "smoke"},
    {PreviewLook::fire, "fire"},
    {PreviewLook::nebula, "nebula"},
    {PreviewLook::solid, "solid"},
}};

constexpr std::tuple<> fields_of(std::type_identity<BoxShape>) {
  return {};
}
constexpr std::tuple<> fields_of(std::type_identity<SphereShape>) {
  return {};
}
constexpr std::tuple<> fields_of(std::type_identity<EllipsoidShape>) {
  return {};
}
constexpr auto fields_of(std::type_identity<MeshShape>) {
  return list_fields(field("file", &MeshShape::file, "A closed mesh: .ply .obj .off .stl .om"),
                     field("digest", &MeshShape::digest, "Of the file, where the volume exists already")
                         .written_if([](const MeshShape& mesh) { return !mesh.digest.empty(); }));
}

// Within which noises of most frequencies can be evaluated, world units.
inline constexpr double kFarthest = 1e9;

constexpr auto fields_of(std::type_identity<Domain>) {
  return list_fields(
      field("shape", &Domain::shape,
            "Which voxels there are: of the box, of the sphere or ellipsoid in it, of the inside of a closed "
            "mesh (.ply .obj .off .stl .om), or those of a grid"),
      field("box", &Domain::box, kFinite, "world units", "Two corners"),
      field("voxel", &Domain::voxel, kPositive, "world units", "Size of a voxel"),
      field("dim", &Domain::dim, between(1, 1 << 20), "voxels",
            "Along the box's longest side, the first centre on it, in place of voxel")
          .in_place_of("voxel")
          .written_if([](const Domain& domain) { return !domain.voxel; }),
      field("edge", &Domain::edge, between(0.0, kFarthest), "world units",
            "Width over which densities end at the shape's surface"),
      field("edge_voxels", &Domain::edge_voxels, between(0.0, 1e6), "voxels",
            "The same in voxels, in place of edge; without both 2, of a box 0")
          .in_place_of("edge"));
}

constexpr auto fields_of(std::type_identity<DensityScale>) {
  return list_fields(field("optical_depth", &DensityScale::optical_depth, kPositive, "",
                           "Scale: density through the thickest column along the up axis")
                         .written_if([](const DensityScale& density) { return !density.peak; }),
                     field("peak", &DensityScale::peak, kPositive, "extinction per world unit",
                           "Scale, instead: the largest density")
                         .in_place_of("optical_depth"),
                     field("factor", &DensityScale::factor, kPositive, "",
                           "Scale: what densities are multiplied by, as another volume's metadata has it"));
}

// Of a grid in both forms of recipes, the list's and the short one.
constexpr auto fields_of_any_grid() {
  using Grid = GridRecipe;
  return list_fields(
      field("layers", &Grid::layers, "Their sum takes the noise's place").written_if([](const Grid& grid) {
        return !grid.layers.empty();
      }),
      field("shaping", &Grid::shaping, "What becomes of the noise"),
      field("output", &Grid::output,
            "value, gradient or both (value,gradient); curl: a velocity without divergence; color: three "
            "independent noises; phase,intensity: of gabor-oriented noise")
          .written_if([](const Grid& grid) { return grid.output != std::vector{Output::value}; }),
      field("speed", &Grid::speed, kPositive, "world units per second",
            "Of curl: root mean square of the velocity")
          .written_if([](const Grid& grid) { return grid.speed != 1.0; }),
      field("drift", &Grid::drift, kFinite, "world units per second",
            "Of curl: a mean velocity that is added")
          .written_if([](const Grid& grid) { return grid.drift != Vec<3>(0.0); }),
      field("boundary", &Grid::boundary, "Of curl: a level set that nothing flows through"),
      field("boundary_width", &Grid::boundary_width, kPositive, "world units",
            "Distance from it over which the velocity turns along it; left out, 1 / frequency"),
      field("within", &Grid::within, "Clamped to 0..1, what the values are multiplied by"),
      field("sparse", &Grid::sparse, "Of raw values: leave voxels out that are 0")
          .written_if([](const Grid& grid) { return grid.sparse; }),
      field("prune", &Grid::prune, between(0.0, 1.0), "of the largest density",
            "Leave out densities below this part")
          .written_if([](const Grid& grid) { return grid.prune != 0.0; }),
      field("half", &Grid::half, "Store 16-bit floats: half the size, 3 digits"));
}

constexpr auto fields_of(std::type_identity<GridRecipe>) {
  using Grid = GridRecipe;
  return list_fields(
      field("name", &Grid::grid, "Name of the grid; left out, that of its output: density, vel, ...")
          .written_if([](const Grid& grid) { return !grid.grid.empty(); }),
      field("noise", &Grid::own, "Of its own; left out, the recipe's"), fields_of_any_grid(),
      field("scale", &Grid::density, "What densities are scaled to").written_if([](const Grid& grid) {
        return !std::holds_alternative<RawShaping>(grid.shaping) || grid.density != DensityScale{};
      }));
}

constexpr auto fields_of(std::type_identity<VolumeRecipe>) {
  using Recipe = VolumeRecipe;
  return list_fields(
      field("description", &Recipe::description, "For people; changes nothing")
          .written_if([](const Recipe& recipe) { return !recipe.description.empty(); }),
      field("noise", &Recipe::noise, "The noise"),
      field("dims", &Recipe::dims, between(3, 4), "",
            "Dimensions of the noise; 4: a frame is a slice of a noise of 4, which changes with time"),
      field("time", &Recipe::time, kFinite, "",
            "Of a noise that changes or moves (evolve, 4 dimensions, wind): the moment to make"),
      field("offset", &Recipe::offset, between(-kFarthest, kFarthest), "world units", "Moves the noise"),
      field("wind", &Recipe::wind, between(-kFarthest, kFarthest), "world units per unit of time",
            "Moves the noise as time passes")
          .written_if([](const Recipe& recipe) { return recipe.wind != Vec<3>(0.0); }),
      field("band_limit", &Recipe::band_limit,
            "Gabor noises: filter out what the voxels cannot hold, exactly, so that looks do not depend on "
            "the resolution"),
      field("exact", &Recipe::exact,
            "Sum impulses at every voxel; without it, waves that voxels resolve well are interpolated from "
            "fewer samples, within the error"),
      part(&Recipe::parameters),
      field("up", &Recipe::up, kUpAxisChoices, "The up axis, kept in the file; shapes stand on it"),
      field("codec", &Recipe::codec, kCodecChoices,
            "Compression of the file; zip gains nothing on fog volumes"),
      field("look", &Recipe::look, kLookChoices, "What a preview shows the volume as")
          .written_if([](const Recipe& recipe) { return recipe.look != PreviewLook::automatic; }),
      field("fields", &Recipe::fields,
            "Fields with names, for layers to use; what is used by several is evaluated once")
          .written_if([](const Recipe& recipe) { return !recipe.fields.empty(); }),
      field("grids", &Recipe::grids, "The grids. Of a single one the keys may also be the recipe's own"));
}

// The JSON form of a volume:
//   {"solidnoise": 2, "algorithm": 5, "noise": {"type": "gabor", ...}, "dims": 3, "time": 0,
//    "offset": [0, 0, 0],
//    "fields": {"billows": {"fold": "billow", ...}, ...},
//    "grids": [{"name": "density", "layers": [{"use": "billows"}], "shaping": {"type": "remap", ...},
//               "scale": {"optical_depth": 60}, "half": false}, ...],
//    "domain": {"shape": {"type": "box"}, "box": [x0, ..., z1], "dim": 256}, "up": "y", "codec": "blosc"}
// A grid has "noise" where it has one of its own, "output" where that is not "value", and "speed", "drift",
// "boundary" ({"file": ..., "grid": ...}) and "boundary_width" where they are needed; "peak" may take the
// place of "optical_depth", "voxel" that of "dim"; "factor" is there where it is known. "algorithm" is
// kAlgorithmVersion when the recipe was written. Every key but "solidnoise" may be left out. A recipe that
// works on a grid that exists has the keys of a Modification in place of "domain" and "name", which are
// the grid's. Reading back what was written gives an equal recipe, to the last bit, but for what has no
// effect.
//
// The short form, which version 1 was, has the keys of a single grid and of the domain as its own, with
// "grid" for the name and "optical_depth", "density" or "density_factor" for the scale. It is read, not
// written.
Json to_json(const VolumeRecipe& recipe);

// Throws std::invalid_argument with the path in the tree: another version, wrong type, unknown key, two keys
// that contradict each other, value out of range.
VolumeRecipe volume_recipe_from_json(const Json& json);

// The words for the alternatives of Shaping, in their order.
std::span<const std::string_view> shaping_types();

// The JSON Schema of a volume.
Json volume_recipe_schema();

}  // namespace solidnoise
