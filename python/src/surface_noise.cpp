#include <algorithm>
#include <optional>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arrays.h"
#include "call.h"
#include "documentation.h"
#include "json.h"
#include "mesh.h"
#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/field_json.h"

namespace solidnoise::python {
namespace {

// One number for all, or one for each vertex, whose values then depend on no other vertex.
VertexNumber vertex_number(py::handle object, const std::string& name, std::size_t vertices) {
  constexpr double kTypical = 1.0;
  const std::vector<double> numbers = numbers_of(object, name);
  if (array_in(object, name).ndim() == 0) return {numbers.front(), {}};
  if (numbers.size() != vertices) {
    throw std::invalid_argument(
        fmt::format("{} has {} numbers; it must be a number, or have one for each of {} vertices", name,
                    numbers.size(), vertices));
  }
  return {kTypical, {numbers.begin(), numbers.end()}};
}

struct SurfaceParameters {
  py::object frequency;
  py::object bandwidth;
  py::object magnitude;
  py::object directions;
};

py::array surface_noise(py::handle points, py::handle normals, py::handle recipe,
                        const SurfaceParameters& parameters, const Call& call, const py::kwargs& keywords) {
  SurfaceNoiseRecipe read;
  use_recipe(recipe, keywords, [&](const Json& json) {
    JsonReader reader(json);
    read_fields(reader, read);
    reader.finish();
    reader.validate(read);
  });
  const std::vector<Vec<3>> positions = vectors_of(points, "points");
  const std::vector<Vec<3>> at = vectors_of(normals, "normals");
  std::vector<Vec<3>> directions;
  if (!parameters.directions.is_none()) directions = vectors_of(parameters.directions, "directions");
  BakeVertices vertices;
  vertices.positions = positions;
  vertices.normals = at;
  vertices.frequency = vertex_number(parameters.frequency, "frequency", positions.size());
  vertices.bandwidth = vertex_number(parameters.bandwidth, "bandwidth", positions.size());
  vertices.magnitude = vertex_number(parameters.magnitude, "magnitude", positions.size());
  vertices.directions = directions;
  std::vector<float> values;
  run(call, [&](Progress& told) { values = bake_noise(read, vertices, &told); });
  return array_of(std::move(values));
}

}  // namespace

void add_surface_noise(py::module_& module) {
  using namespace py::literals;
  module.def(
      "surface_noise",
      [](py::handle points, py::handle normals, py::handle recipe, py::object frequency, py::object bandwidth,
         py::object magnitude, py::object directions, std::optional<int> threads, py::object progress,
         const py::kwargs& keywords) {
        return surface_noise(
            points, normals, recipe,
            {std::move(frequency), std::move(bandwidth), std::move(magnitude), std::move(directions)},
            {threads, std::move(progress)}, keywords);
      },
      "points"_a, "normals"_a, "recipe"_a = py::none(), py::kw_only(), "frequency"_a = 8.0,
      "bandwidth"_a = 1.0, "magnitude"_a = 1.0, "directions"_a = py::none(), "threads"_a = py::none(),
      "progress"_a = py::none(),
      document(
          "surface_noise(points, normals, recipe=None, *, frequency=8.0, bandwidth=1.0, magnitude=1.0, "
          "directions=None, "
          "threads=None, progress=None, **keys)",
          R"(Noise on a surface, at points that have normals, with parameters that may differ from point to point.

points, normals : arrays (n, 3)
    Positions, world units, and smooth normals of any length but 0.
frequency : float or array (n,), cycles per world unit
bandwidth : float or array (n,), 0.1 to 4, octaves
magnitude : float or array (n,), at least 0
    The standard deviation of values.
directions : array (n, 3)
    Of oriented noise: along which its waves travel, of either sign; shorter than 1 where waves are to
    be longer, down to 0 where there is no direction.
recipe, keys
    Of the noise:

)" + describe_options(schema_of<SurfaceNoiseRecipe>()) +
              "\nReturns float32 (n,), of mean 0. Raises ValueError.")
          .c_str());
}

}  // namespace solidnoise::python
