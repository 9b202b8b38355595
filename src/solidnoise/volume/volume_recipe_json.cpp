#include "solidnoise/volume/volume_recipe_json.h"

#include <array>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/recipe/recipe_header.h"
#include "solidnoise/volume/layer_json.h"
#include "solidnoise/volume/modify/modification_json.h"
#include "solidnoise/volume/parameters/parameter_grids_json.h"
#include "solidnoise/volume/vdb/grid_file_json.h"

namespace solidnoise {
namespace {

// In the order of the alternatives of Shape and Shaping.
const std::vector<std::string_view> kShapeTypes{"box", "sphere", "ellipsoid", "mesh", "grid"};
const std::vector<std::string_view> kShapingTypes{"raw", "remap", "veins", "cloud"};
static_assert(std::variant_size_v<Shape> == 5 && std::variant_size_v<Shaping> == 4, "name each alternative");

template <typename Variant, std::size_t... Is>
Variant default_alternative(std::size_t index, std::index_sequence<Is...>) {
  Variant variant;
  ((Is == index ? static_cast<void>(variant.template emplace<Is>()) : void()), ...);
  return variant;
}

template <typename Variant>
Variant default_alternative(std::size_t index) {
  return default_alternative<Variant>(index, std::make_index_sequence<std::variant_size_v<Variant>>());
}

Json shape_to_json(const Shape& shape) {
  Json json = Json::object();
  json["type"] = kShapeTypes[shape.index()];
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
    json["file"] = mesh->file;
    if (!mesh->digest.empty()) json["digest"] = mesh->digest;
  }
  if (const auto* grid = std::get_if<GridShape>(&shape)) add_grid_file(json, *grid);
  return json;
}

Shape shape_from_json(JsonReader& reader) {
  Shape shape = default_alternative<Shape>(reader.read_choice("type", kShapeTypes));
  if (auto* mesh = std::get_if<MeshShape>(&shape)) {
    reader.read("file", mesh->file);
    reader.read("digest", mesh->digest);
  }
  if (auto* grid = std::get_if<GridShape>(&shape)) read_grid_file(reader, *grid);
  reader.finish();
  return shape;
}

Json shaping_to_json(const Shaping& shaping) {
  Json json = Json::object();
  json["type"] = kShapingTypes[shaping.index()];
  if (const auto* raw = std::get_if<RawShaping>(&shaping)) json["range"] = name_of(kRangeChoices, raw->range);
  if (const auto* remap = std::get_if<RemapShaping>(&shaping)) {
    json["fold"] = name_of(kFoldChoices, remap->fold);
    json["threshold"] = remap->threshold;
    json["softness"] = remap->softness;
    json["power"] = remap->power;
    json["edge"] = remap->edge;
    json["floor"] = remap->floor;
  }
  if (const auto* veins = std::get_if<VeinShaping>(&shaping)) {
    json["direction"] = {veins->direction.x, veins->direction.y, veins->direction.z};
    json["spacing"] = veins->spacing;
    json["turbulence"] = veins->turbulence;
    json["sharpness"] = veins->sharpness;
    json["floor"] = veins->floor;
  }
  if (const auto* cloud = std::get_if<CloudShaping>(&shaping)) {
    json["puffs"] = cloud->puffs;
    json["lobes"] = cloud->lobes;
    json["base"] = cloud->base;
    json["edge"] = cloud->edge;
    json["wisps"] = cloud->wisps;
    json["core"] = cloud->core;
    json["lean"] = cloud->lean;
  }
  return json;
}

Shaping shaping_from_json(JsonReader& reader) {
  Shaping shaping = default_alternative<Shaping>(reader.read_choice("type", kShapingTypes));
  if (auto* raw = std::get_if<RawShaping>(&shaping)) reader.read("range", kRangeChoices, raw->range);
  if (auto* remap = std::get_if<RemapShaping>(&shaping)) {
    reader.read("fold", kFoldChoices, remap->fold);
    reader.read("threshold", remap->threshold);
    reader.read("softness", remap->softness);
    reader.read("power", remap->power);
    reader.read("edge", remap->edge);
    reader.read("floor", remap->floor);
  }
  if (auto* veins = std::get_if<VeinShaping>(&shaping)) {
    reader.read("direction", veins->direction);
    reader.read("spacing", veins->spacing);
    reader.read("turbulence", veins->turbulence);
    reader.read("sharpness", veins->sharpness);
    reader.read("floor", veins->floor);
  }
  if (auto* cloud = std::get_if<CloudShaping>(&shaping)) {
    reader.read("puffs", cloud->puffs);
    reader.read("lobes", cloud->lobes);
    reader.read("base", cloud->base);
    reader.read("edge", cloud->edge);
    reader.read("wisps", cloud->wisps);
    reader.read("core", cloud->core);
    reader.read("lean", cloud->lean);
  }
  reader.finish();
  std::visit([&](const auto& look) { reader.validate(look); }, shaping);
  return shaping;
}

void add_boundary(Json& json, const Boundary& boundary) {
  json["boundary"] = Json::object();
  add_grid_file(json["boundary"], boundary.surface);
  if (boundary.width) json["boundary_width"] = *boundary.width;
}

void read_boundary(JsonReader& reader, std::optional<Boundary>& boundary) {
  std::optional<GridFile> surface;
  std::optional<double> width;
  read_grid_file(reader, "boundary", surface);
  reader.read("boundary_width", width);
  if (width && !surface) throw std::invalid_argument("boundary_width applies to a boundary only");
  if (surface) boundary = Boundary{*surface, width};
}

void refuse_both(const JsonReader& reader, const char* one, const char* other) {
  if (!reader.has(one) || !reader.has(other)) return;
  throw std::invalid_argument(fmt::format("{} and {} contradict each other; give one of them", one, other));
}

// What a grid of one's own has, and one that is modified brings along.
constexpr std::array kShapeKeys{"shape", "box", "voxel", "dim", "grid"};

void add_shape(Json& json, const VolumeRecipe& recipe) {
  json["shape"] = shape_to_json(recipe.shape);
  const Vec<3>& lower = recipe.box.lower;
  const Vec<3>& upper = recipe.box.upper;
  json["box"] = {lower.x, lower.y, lower.z, upper.x, upper.y, upper.z};
  if (recipe.voxel) {
    json["voxel"] = *recipe.voxel;
  } else {
    json["dim"] = recipe.dim;
  }
}

}  // namespace

Json to_json(const VolumeRecipe& recipe) {
  Json json = recipe_header();
  if (!recipe.description.empty()) json["description"] = recipe.description;
  json["noise"] = to_json(recipe.noise);
  add_layers(json, recipe.layers);
  json["dims"] = recipe.dims;
  json["time"] = recipe.time;
  json["offset"] = {recipe.offset.x, recipe.offset.y, recipe.offset.z};
  json["band_limit"] = recipe.band_limit;
  json["exact"] = recipe.exact;
  add_parameter_grids(json, recipe.parameters);
  json["shaping"] = shaping_to_json(recipe.shaping);
  if (!is_scalar(recipe)) json["output"] = format_outputs(recipe.output);
  if (recipe.speed != 1.0) json["speed"] = recipe.speed;
  if (recipe.boundary) add_boundary(json, *recipe.boundary);
  if (recipe.density.peak) {
    json["density"] = *recipe.density.peak;
  } else {
    json["optical_depth"] = recipe.density.optical_depth;
  }
  if (recipe.density.factor) json["density_factor"] = *recipe.density.factor;
  if (recipe.modification) {
    add_modification(json, *recipe.modification);
  } else {
    add_shape(json, recipe);
  }
  json["up"] = name_of(kUpAxisChoices, recipe.up);
  if (!recipe.modification && recipe.output.size() == 1) json["grid"] = grid_names(recipe).front();
  json["half"] = recipe.half;
  json["codec"] = name_of(kCodecChoices, recipe.codec);
  return json;
}

VolumeRecipe volume_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);
  refuse_both(reader, "optical_depth", "density");
  refuse_both(reader, "voxel", "dim");

  VolumeRecipe recipe;
  reader.read("description", recipe.description);
  if (auto noise = reader.object("noise")) recipe.noise = noise_recipe_from_json(*noise);
  read_layers(reader, recipe.layers);
  reader.read("dims", recipe.dims);
  reader.read("time", recipe.time);
  reader.read("offset", recipe.offset);
  reader.read("band_limit", recipe.band_limit);
  reader.read("exact", recipe.exact);
  read_parameter_grids(reader, recipe.parameters);
  if (auto shaping = reader.object("shaping")) recipe.shaping = shaping_from_json(*shaping);
  std::string output = format_outputs(recipe.output);
  reader.read("output", output);
  recipe.output = parse_outputs(output);
  reader.read("speed", recipe.speed);
  read_boundary(reader, recipe.boundary);
  reader.read("optical_depth", recipe.density.optical_depth);
  reader.read("density", recipe.density.peak);
  reader.read("density_factor", recipe.density.factor);
  read_modification(reader, recipe.modification);
  for (const char* key : kShapeKeys) {
    if (!recipe.modification || !reader.has(key)) continue;
    throw std::invalid_argument(
        fmt::format("{} has no effect where a grid that exists is worked on, which has its own", key));
  }
  if (auto shape = reader.object("shape")) recipe.shape = shape_from_json(*shape);
  reader.read("box", recipe.box);
  reader.read("voxel", recipe.voxel);
  reader.read("dim", recipe.dim);
  reader.read("up", kUpAxisChoices, recipe.up);
  reader.read("grid", recipe.grid);
  if (reader.has("grid") && recipe.grid.empty()) {
    throw std::invalid_argument("grid is empty; it must be a name");
  }
  reader.read("half", recipe.half);
  reader.read("codec", kCodecChoices, recipe.codec);
  reader.finish();
  reader.validate(recipe);
  return recipe;
}

}  // namespace solidnoise
