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
  run({std::nullopt, py::none()}, [&](Progress& told) { json = describe_volume(read, {.progress = &told}); });
  return object_of(json);
}

py::object analyze_grid(const GridObject& of, const Call& call) {
  const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(of.grid);
  if (!floats) {
    throw std::invalid_argument(
        fmt::format("grid {} is of {}; it must be of float", of.grid->getName(), of.grid->valueType()));
  }
  Json json;
  run(call, [&](Progress& told) {
    const AnalysisSubject subject = analysis_subject(floats, of.file);
    throw_if_cancelled(&told);
    json = analyze(subject, &told).json;
  });
  return object_of(json);
}

py::object analyze_any(const py::object& what, const std::optional<std::string>& grid,
                       std::optional<int> threads, py::object progress) {
  const Call call(threads, std::move(progress));
  if (py::isinstance<GridObject>(what)) return analyze_grid(what.cast<const GridObject&>(), call);
  if (py::isinstance<VolumeObject>(what))
    return analyze_grid(find_grid(what.cast<const VolumeObject&>(), grid), call);
  if (!is_path(what)) {
    throw py::type_error("what is a " + name_of_type(what) +
                         "; it must be a Grid, a Volume or the path of a .vdb");
  }
  const std::filesystem::path path = path_of(what);
  GridObject of{nullptr, path.string()};
  run({threads, py::none()},
      [&](Progress& told) { of.grid = read_float_grid(path, grid.value_or(""), &told); });
  return analyze_grid(of, call);
}

}  // namespace

void add_measures(py::module_& module) {
  using namespace py::literals;
  module.def("describe", &describe_object, "recipe"_a = py::none(),
             R"(describe(recipe=None, **keys)
--

What a recipe, as of make_volume(), would make, without making it: a dict with the noise's kernel and statistics in closed form, voxels,
memory and seconds.)");
  module.def("analyze", &analyze_any, "what"_a, "grid"_a = py::none(), py::kw_only(),
             "threads"_a = py::none(), "progress"_a = py::none(),
             R"(analyze(what, grid=None, *, threads=None, progress=None)
--

Measures a grid of floats: moments, histogram and radial power spectrum, each beside the closed form of the recipe that it carries.

what : Grid, Volume, or the path of a .vdb
grid : str
    The name of the grid; left out, the first one.
threads, progress
    As of Noise.

Returns a dict, what vdbnoise analyze prints.)");
}

}  // namespace solidnoise::python
