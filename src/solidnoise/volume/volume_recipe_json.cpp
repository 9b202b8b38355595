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

Json domain_to_json(const VolumeRecipe& recipe) {
  Json json = Json::object();
  json["shape"] = shape_to_json(recipe.shape);
  const Vec<3>& lower = recipe.box.lower;
  const Vec<3>& upper = recipe.box.upper;
  json["box"] = {lower.x, lower.y, lower.z, upper.x, upper.y, upper.z};
  if (recipe.voxel) {
    json["voxel"] = *recipe.voxel;
  } else {
    json["dim"] = recipe.dim;
  }
  return json;
}

void read_domain(JsonReader& reader, VolumeRecipe& recipe) {
  refuse_both(reader, "voxel", "dim");
  if (auto shape = reader.object("shape")) recipe.shape = shape_from_json(*shape);
  reader.read("box", recipe.box);
  reader.read("voxel", recipe.voxel);
  reader.read("dim", recipe.dim);
}

// `grid` has all that it is by default.
Json grid_to_json(const GridRecipe& grid, const VolumeRecipe& recipe) {
  Json json = Json::object();
  if (!recipe.modification && grid.output.size() == 1) {
    json["name"] = grid.grid.empty() ? std::string(default_grid_name(grid.output.front())) : grid.grid;
  }
  if (grid.own) json["noise"] = to_json(*grid.own);
  add_layers(json, grid.layers);
  write_alternative(grid.shaping, kShapingTypes, json["shaping"]);
  if (grid.output != std::vector{Output::value}) json["output"] = format_outputs(grid.output);
  if (grid.speed != 1.0) json["speed"] = grid.speed;
  if (grid.drift != Vec<3>(0.0)) json["drift"] = {grid.drift.x, grid.drift.y, grid.drift.z};
  if (grid.boundary) add_boundary(json, *grid.boundary);
  if (!std::holds_alternative<RawShaping>(grid.shaping) || grid.density != DensityScale{}) {
    Json& scale = json["scale"] = Json::object();
    if (grid.density.peak) {
      scale["peak"] = *grid.density.peak;
    } else {
      scale["optical_depth"] = grid.density.optical_depth;
    }
    if (grid.density.factor) scale["factor"] = *grid.density.factor;
  }
  if (grid.within) json["within"] = json_of(*grid.within);
  if (grid.sparse) json["sparse"] = true;
  json["half"] = grid.half;
  return json;
}

// What a grid has in both forms, the list's and the short one.
void read_grid_fields(JsonReader& reader, GridRecipe& grid) {
  read_layers(reader, grid.layers);
  if (auto shaping = reader.object("shaping")) grid.shaping = shaping_from_json(*shaping);
  std::string output = format_outputs(grid.output);
  reader.read("output", output);
  grid.output = parse_outputs(output);
  reader.read("speed", grid.speed);
  reader.read("drift", grid.drift);
  read_boundary(reader, grid.boundary);
  if (reader.has("within")) read_value(reader, "within", grid.within.emplace());
  reader.read("sparse", grid.sparse);
  reader.read("half", grid.half);
}

void read_name(JsonReader& reader, const char* key, std::string& name) {
  reader.read(key, name);
  if (reader.has(key) && name.empty()) {
    throw std::invalid_argument(reader.path_of(key) + " is empty; it must be a name");
  }
}

GridRecipe grid_from_json(JsonReader& reader) {
  GridRecipe grid;
  read_name(reader, "name", grid.grid);
  if (auto noise = reader.object("noise")) grid.own = noise_recipe_from_json(*noise);
  read_grid_fields(reader, grid);
  if (auto scale = reader.object("scale")) {
    refuse_both(*scale, "optical_depth", "peak");
    scale->read("optical_depth", grid.density.optical_depth);
    scale->read("peak", grid.density.peak);
    scale->read("factor", grid.density.factor);
    scale->finish();
  }
  reader.finish();
  return grid;
}

// A list of one grid of the recipe's noise is a short form, which flags can change.
void read_grids(JsonReader& reader, VolumeRecipe& recipe) {
  for (JsonReader& grid : reader.objects("grids")) recipe.grids.push_back(grid_from_json(grid));
  if (recipe.grids.size() != 1 || recipe.grids.front().own) return;
  static_cast<GridRecipe&>(recipe) = recipe.grids.front();
  recipe.grids.clear();
}

// The short form: a single grid, whose keys are the recipe's.
void read_short_form(JsonReader& reader, VolumeRecipe& recipe) {
  refuse_both(reader, "optical_depth", "density");
  read_grid_fields(reader, recipe);
  reader.read("optical_depth", recipe.density.optical_depth);
  reader.read("density", recipe.density.peak);
  reader.read("density_factor", recipe.density.factor);
  read_name(reader, "grid", recipe.grid);
}

void read_fields_by_name(JsonReader& reader, NamedLayers& fields) {
  auto object = reader.object("fields");
  if (!object) return;
  for (const std::string& name : object->keys()) read_value(*object, name, fields[name]);
  object->finish();
}

}  // namespace

Json to_json(const VolumeRecipe& recipe) {
  Json json = recipe_header();
  if (!recipe.description.empty()) json["description"] = recipe.description;
  json["noise"] = to_json(recipe.noise);
  json["dims"] = recipe.dims;
  json["time"] = recipe.time;
  json["offset"] = {recipe.offset.x, recipe.offset.y, recipe.offset.z};
  json["band_limit"] = recipe.band_limit;
  json["exact"] = recipe.exact;
  add_parameter_grids(json, recipe.parameters);
  for (const auto& [name, layer] : recipe.fields) json["fields"][name] = json_of(layer);
  for (const GridRecipe& grid : recipe.grids) json["grids"].push_back(grid_to_json(grid, recipe));
  if (recipe.grids.empty()) json["grids"].push_back(grid_to_json(recipe, recipe));
  if (recipe.modification) {
    add_modification(json, *recipe.modification);
  } else {
    json["domain"] = domain_to_json(recipe);
  }
  json["up"] = name_of(kUpAxisChoices, recipe.up);
  json["codec"] = name_of(kCodecChoices, recipe.codec);
  return json;
}

VolumeRecipe volume_recipe_from_json(const Json& json) {
  JsonReader reader(json);
  read_recipe_header(reader);

  VolumeRecipe recipe;
  reader.read("description", recipe.description);
  if (auto noise = reader.object("noise")) recipe.noise = noise_recipe_from_json(*noise);
  reader.read("dims", recipe.dims);
  reader.read("time", recipe.time);
  reader.read("offset", recipe.offset);
  reader.read("band_limit", recipe.band_limit);
  reader.read("exact", recipe.exact);
  read_parameter_grids(reader, recipe.parameters);
  read_fields_by_name(reader, recipe.fields);
  if (reader.has("grids")) {
    read_grids(reader, recipe);
  } else {
    read_short_form(reader, recipe);
  }
  read_modification(reader, recipe.modification);
  for (const char* key : {"domain", "shape", "box", "voxel", "dim", "grid"}) {
    if (!recipe.modification || !reader.has(key)) continue;
    throw std::invalid_argument(
        fmt::format("{} has no effect where a grid that exists is worked on, which has its own", key));
  }
  if (auto domain = reader.object("domain")) {
    read_domain(*domain, recipe);
    domain->finish();
  }
  read_domain(reader, recipe);
  reader.read("up", kUpAxisChoices, recipe.up);
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
  add("fields", {{"type", "object"}, {"additionalProperties", {{"$ref", "#/$defs/layer"}}}},
      "Fields with names, for layers to use; what is used by several is evaluated once");
  add("grids", {{"type", "array"}, {"items", {{"$ref", "#/$defs/grid"}}}, {"minItems", 1}},
      "The grids. Of a single one the keys may also be the recipe's own, as below");
  add("domain", {{"$ref", "#/$defs/domain"}},
      "Where there are voxels; its keys may also be the recipe's own");
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
  add("drift", numbers_schema(kFinite, 3), "Of curl: a mean velocity that is added",
      "world units per second");
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
  add("within", {{"$ref", "#/$defs/layer"}}, "Clamped to 0..1, what the values are multiplied by");
  add("sparse", yes_or_no, "Of raw values: leave voxels out that are 0");
  add("half", yes_or_no, "Store 16-bit floats");
  add("codec", words_schema(names_of(kCodecChoices)), "Compression of the file");

  const auto some_of = [&](const std::vector<const char*>& keys) {
    Json some = Json::object();
    for (const char* key : keys) some[key] = properties[key];
    return some;
  };
  Json grid = some_of({"noise", "layers", "shaping", "output", "speed", "drift", "boundary", "boundary_width",
                       "within", "sparse", "half"});
  grid["name"] = text;
  grid["scale"] = object_schema({{"optical_depth", number_schema(kPositive)},
                                 {"peak", number_schema(kPositive)},
                                 {"factor", number_schema(kPositive)}});
  const Json domain = object_schema(some_of({"shape", "box", "voxel", "dim"}));
  Json schema = file_schema("A volume of noise, for vdbnoise", object_schema(std::move(properties)));
  schema["$defs"] = {{"noise", noise_recipe_schema()},
                     {"layer", schema_of<Layer>()},
                     {"grid", object_schema(std::move(grid))},
                     {"domain", domain}};
  return schema;
}

}  // namespace solidnoise
