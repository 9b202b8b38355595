#include "solidnoise/volume/volume_recipe_json.h"

#include <array>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/field_json.h"
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
  Shape shape;
  make_alternative(shape, reader.read_choice("type", kShapeTypes));
  if (auto* mesh = std::get_if<MeshShape>(&shape)) {
    reader.read("file", mesh->file);
    reader.read("digest", mesh->digest);
  }
  if (auto* grid = std::get_if<GridShape>(&shape)) read_grid_file(reader, *grid);
  reader.finish();
  return shape;
}

Shaping shaping_from_json(JsonReader& reader) {
  Shaping shaping;
  read_alternative(reader, kShapingTypes, shaping);
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
  write_alternative(recipe.shaping, kShapingTypes, json["shaping"]);
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

Json volume_recipe_schema() {
  const VolumeRecipe defaults;
  Json properties = Json::object();
  const auto add = [&](const char* key, Json schema, std::string_view help, std::string_view unit = {}) {
    describe_schema(schema, help, unit);
    properties[key] = std::move(schema);
  };
  const auto add_keys = [&](const Json& object) { properties.update(object["properties"]); };
  const Json text{{"type", "string"}};
  const Json yes_or_no{{"type", "boolean"}, {"default", false}};
  const Json surface = schema_of<GridFile>();

  add("description", text, "For people; changes nothing");
  add("noise", {{"$ref", "#/$defs/noise"}}, "The noise");
  add("layers", schema_of_value<std::vector<Layer>>(), "Their sum takes the noise's place");
  add("dims", integer_schema(between(3, 4), false),
      "Of the noise; 4: a frame of a noise that changes in time");
  add("time", number_schema(kFinite), "Of the frame");
  add("offset", numbers_schema(kFinite, 3), "Moves the noise", "world units");
  add("band_limit", yes_or_no, "Filter the noise at the size of the voxels");
  add("exact", yes_or_no, "Sum impulses at every voxel");
  add_keys(schema_of<ParameterGrids>());
  add("shaping", alternatives_schema(std::type_identity<Shaping>(), kShapingTypes),
      "What becomes of the noise");
  add("output", text, "value, gradient or both; curl; color; phase,intensity");
  add("speed", number_schema(kPositive), "Of curl: root mean square", "world units per second");
  add("boundary", surface, "Of curl: a level set that nothing flows through");
  add("boundary_width", number_schema(kPositive), "Distance over which the velocity turns", "world units");
  add("optical_depth", number_schema(kPositive), "Through the thickest column along the up axis");
  add("density", number_schema(kPositive), "Instead: the largest density", "extinction per world unit");
  add("density_factor", number_schema(kPositive), "What densities are multiplied by, where that is known");
  add_keys(schema_of<Modification>());
  add("shape",
      {{"type", "object"},
       {"properties",
        {{"type", words_schema(kShapeTypes)}, {"file", text}, {"grid", text}, {"digest", text}}},
       {"required", {"type"}},
       {"additionalProperties", false}},
      "Which voxels there are: of the box, of the inside of a mesh, or of a grid");
  add("box", numbers_schema(kFinite, 6), "Two corners", "world units");
  add("voxel", number_schema(kPositive), "Size of a voxel", "world units");
  Json& dim = properties["dim"] = integer_schema(between(1, 1 << 20), false);
  dim["default"] = defaults.dim;
  describe_schema(dim, "Instead: voxels along the longest side", {});
  add("up", words_schema(names_of(kUpAxisChoices)), "The up axis");
  add("grid", text, "Name of the grid");
  add("half", yes_or_no, "Store 16-bit floats");
  add("codec", words_schema(names_of(kCodecChoices)), "Compression of the file");

  Json schema = file_schema("A volume of noise, for vdbnoise", object_schema(std::move(properties)));
  schema["$defs"] = {{"noise", noise_recipe_schema()}, {"layer", schema_of<Layer>()}};
  return schema;
}

}  // namespace solidnoise
