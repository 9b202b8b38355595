#include <filesystem>
#include <pybind11/stl.h>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "call.h"
#include "json.h"
#include "solidnoise/volume/analyze_volume.h"
#include "solidnoise/volume/describe_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "volume.h"

namespace solidnoise::python {

namespace {

py::object describe_object(py::handle recipe, const py::kwargs& keywords) {
  const VolumeRecipe read = volume_recipe_of(recipe, keywords);
  Json json;
  run({std::nullopt, py::none()}, [&](Progress&) { json = describe_volume(read); });
  return object_of(json);
}

py::object analyze_grid(const GridObject& of) {
  const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(of.grid);
  if (!floats) {
    throw std::invalid_argument(
        fmt::format("grid {} is of {}; it must be of float", of.grid->getName(), of.grid->valueType()));
  }
  Json json;
  run({std::nullopt, py::none()}, [&](Progress&) { json = analyze(analysis_subject(floats, of.file)).json; });
  return object_of(json);
}

py::object analyze_any(const py::object& what, const std::optional<std::string>& grid) {
  if (py::isinstance<GridObject>(what)) return analyze_grid(what.cast<const GridObject&>());
  if (py::isinstance<VolumeObject>(what))
    return analyze_grid(find_grid(what.cast<const VolumeObject&>(), grid));
  const std::filesystem::path path = path_of(what);
  GridObject of{nullptr, path.string()};
  run({std::nullopt, py::none()}, [&](Progress&) { of.grid = read_float_grid(path, grid.value_or("")); });
  return analyze_grid(of);
}

}  // namespace

void add_measures(py::module_& module) {
  using namespace py::literals;
  module.def("describe", &describe_object, "recipe"_a = py::none(),
             R"(describe(recipe=None, **keys)
--

What a recipe, as of make_volume(), would make, without making it: a dict with the noise's kernel and statistics in closed form, voxels,
memory and seconds.)");
  module.def("analyze", &analyze_any, "what"_a, "grid"_a = py::none(), R"(analyze(what, grid=None)
--

Measures a grid of floats: moments, histogram and radial power spectrum, each beside the closed form of the recipe that it carries.

what : Grid, Volume, or the path of a .vdb
grid : str
    The name of the grid; left out, the first one.

Returns a dict, what vdbnoise analyze prints.)");
}

}  // namespace solidnoise::python
