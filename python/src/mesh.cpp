#include "mesh.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <pybind11/stl.h>
#include <ranges>
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
#include "solidnoise/core/check.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/surface_mesh.h"
#include "solidnoise/recipe/exemplar_model_json.h"

namespace solidnoise::python {
namespace {

// Negative indices, too large ones, and those of too few corners are the caller's mistakes.
std::uint32_t vertex_of(std::int64_t index, std::size_t face, std::size_t vertices) {
  if (index >= 0 && index < static_cast<std::int64_t>(vertices)) return static_cast<std::uint32_t>(index);
  throw std::invalid_argument(
      fmt::format("faces[{}] has the vertex {}; it must be between 0 and {}", face, index, vertices - 1));
}

void add_face(PolygonMesh& mesh, const std::int64_t* corners, std::size_t count) {
  if (count < 3) {
    throw std::invalid_argument(
        fmt::format("faces[{}] has {} corners; it must have 3 at least", mesh.face_count(), count));
  }
  std::vector<std::uint32_t> face;
  for (std::size_t i = 0; i < count; ++i) {
    face.push_back(vertex_of(corners[i], mesh.face_count(), mesh.positions.size()));
  }
  mesh.add_face(face);
}

// Whole numbers of a sequence or an array.
py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> integers_of(py::handle object) {
  const py::array array = array_in(object, "faces");
  if (array.size() > 0 && std::string("iu").find(array.dtype().kind()) == std::string::npos) {
    throw py::type_error("faces must be whole numbers");
  }
  return array;
}

// An array of faces of equal size, or a sequence of faces of any.
void add_faces(PolygonMesh& mesh, py::handle faces) {
  const bool is_list = py::isinstance<py::list>(faces) || py::isinstance<py::tuple>(faces);
  if (is_list) {
    for (const py::handle face : faces) {
      const auto corners = integers_of(face);
      add_face(mesh, corners.data(), static_cast<std::size_t>(corners.size()));
    }
    return;
  }
  const auto rows = integers_of(faces);
  if (rows.ndim() != 2)
    throw std::invalid_argument("faces must have the shape (faces, corners), or be a list of faces");
  const auto corners = static_cast<std::size_t>(rows.shape(1));
  const std::int64_t* const first = rows.data();
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows.shape(0)); ++i)
    add_face(mesh, first + i * corners, corners);
}

PolygonMesh mesh_of(py::handle vertices, py::handle faces, const py::dict& attributes) {
  PolygonMesh mesh;
  mesh.positions = vectors_of(vertices, "vertices");
  mesh.position_type = ScalarType::float64;
  if (mesh.positions.empty()) throw std::invalid_argument("vertices is empty; there must be one at least");
  add_faces(mesh, faces);
  for (const auto& [name, values] : attributes) {
    if (!py::isinstance<py::str>(name)) throw py::type_error("the names of attributes must be texts");
    VertexProperty property{name.cast<std::string>(), ScalarType::float64,
                            numbers_of(values, name.cast<std::string>())};
    if (property.values.size() != mesh.positions.size()) {
      throw std::invalid_argument(fmt::format("{} has {} numbers; it must have one for each of {} vertices",
                                              property.name, property.values.size(), mesh.positions.size()));
    }
    for (const double value : property.values) require_finite(property.name, value);
    mesh.set_property(std::move(property));
  }
  return mesh;
}

// An array (faces, corners) where all have as many, else a list.
py::object faces_of(const PolygonMesh& mesh) {
  const std::size_t count = mesh.face_count();
  const std::size_t corners = count == 0 ? 3 : mesh.face(0).size();
  const auto is_like_the_first = [&](std::size_t i) { return mesh.face(i).size() == corners; };
  const auto numbers = std::views::iota(std::size_t{0}, count);
  if (!std::all_of(numbers.begin(), numbers.end(), is_like_the_first)) {
    py::list faces;
    for (std::size_t i = 0; i < count; ++i) {
      const auto face = mesh.face(i);
      faces.append(array_of(std::vector<std::uint32_t>(face.begin(), face.end())));
    }
    return faces;
  }
  return array_of(std::vector<std::uint32_t>(mesh.corners),
                  {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(corners)});
}

py::array colors_of(const std::vector<Color>& colors) {
  std::vector<float> numbers;
  numbers.reserve(3 * colors.size());
  for (const Color& color : colors) numbers.insert(numbers.end(), {color.r, color.g, color.b});
  return array_of(std::move(numbers), {static_cast<py::ssize_t>(colors.size()), 3});
}

// Of vectors, whose parts are properties of their own, (vertices, 3).
py::object property_of(const PolygonMesh& mesh, const std::string& name) {
  const auto floats = [](const VertexProperty& property) {
    return array_of(std::vector<float>(property.values.begin(), property.values.end()));
  };
  if (const VertexProperty* const property = mesh.property(name)) return floats(*property);
  py::list parts;
  for (const char* const axis : {"_x", "_y", "_z"}) parts.append(floats(*mesh.property(name + axis)));
  return py::module_::import("numpy").attr("stack")(parts, -1);
}

// One name would hide the other.
void require_names(const BakeRecipe& recipe, const std::vector<std::string>& keep) {
  for (const auto& [name, layer] : recipe.properties) {
    const bool is_ours = name == "vertices" || name == "faces" || name == "normals" || name == "colors";
    if (!is_ours && std::ranges::find(keep, name) == keep.end()) continue;
    throw std::invalid_argument(
        fmt::format("properties has {}, which is the name of another array of a bake", name));
  }
}

BakeRecipe bake_recipe_of(py::handle recipe, const py::dict& keywords) {
  BakeRecipe result;
  use_recipe(recipe, keywords, [&](const Json& json) { result = bake_recipe_from_json(with_header(json)); });
  return result;
}

py::dict bake_arrays(py::handle vertices, py::handle faces, py::handle recipe, const py::dict& attributes,
                     const std::vector<std::string>& keep, std::optional<int> threads, py::object progress,
                     const py::kwargs& keywords) {
  const Call call(threads, std::move(progress));
  const BakeRecipe read = bake_recipe_of(recipe, keywords);
  require_names(read, keep);
  PolygonMesh mesh = mesh_of(vertices, faces, attributes);
  BakedMesh baked;
  run(call,
      [&](Progress& told) { baked = bake(plan_bake(std::move(mesh), read, &told), read, keep, &told); });
  py::dict result;
  result["vertices"] = array_of(baked.mesh.positions);
  result["faces"] = faces_of(baked.mesh);
  result["normals"] = array_of(baked.normals);
  result["colors"] = colors_of(baked.colors);
  result["noise"] = property_of(baked.mesh, "noise");
  for (const auto& [name, layer] : read.properties) result[py::str(name)] = property_of(baked.mesh, name);
  for (const std::string& name : keep) result[py::str(name)] = property_of(baked.mesh, name);
  return result;
}

py::dict measure(py::handle vertices, py::handle faces, int smooth, double smooth_radius,
                 std::optional<int> threads, py::object progress) {
  const Call call(threads, std::move(progress));
  const PolygonMesh mesh = mesh_of(vertices, faces, {});
  Curvature measured;
  run(call, [&](Progress& told) {
    measured = measure_curvature(SurfaceMesh(mesh), {smooth, smooth_radius}, &told);
  });
  std::vector<double> mean;
  std::vector<double> gaussian;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    mean.push_back(measured.mean(i));
    gaussian.push_back(measured.gaussian(i));
  }
  py::dict result;
  result["k1"] = array_of(std::move(measured.k1));
  result["k2"] = array_of(std::move(measured.k2));
  result["k1_direction"] = array_of(measured.k1_direction);
  result["k2_direction"] = array_of(measured.k2_direction);
  result["mean"] = array_of(std::move(mean));
  result["gaussian"] = array_of(std::move(gaussian));
  return result;
}

}  // namespace

void add_mesh(py::module_& module) {
  using namespace py::literals;
  module.def("bake", &bake_arrays, "vertices"_a, "faces"_a, "recipe"_a = py::none(), py::kw_only(),
             "attributes"_a = py::dict(), "keep"_a = py::tuple(), "threads"_a = py::none(),
             "progress"_a = py::none(),
             document("bake(vertices, faces, recipe=None, *, attributes={}, keep=(), threads=None, "
                      "progress=None, **keys)",
                      R"(Bakes a noise on a mesh: the same values, to the last bit, as meshnoise bake.

    baked = solidnoise.bake(vertices, faces, solidnoise.preset("rust"), frequency=(4, 32))
    baked["colors"], baked["noise"]

vertices : array (n, 3), world units
    Rest positions. Those at equal places are one point of the surface.
faces : array (m, corners) of whole numbers, or a list of faces of any number of corners
    Indices of vertices.
recipe : dict, or the path of a .json file
    What meshnoise reads and writes; a preset, such as rust.
attributes : dict of arrays (n,)
    Numbers of the vertices, that ranges may follow: by={"attribute": NAME}.
keep : names
    What else is wanted of each vertex: frequency, bandwidth, magnitude, bias, weight (what ranges follow, 0 to 1), steering (the
    number that it is made of), direction.
keys
    Of the recipe: take the place of its own, or, where both are dicts, are merged into them.

The keys of a recipe, where a range is two numbers:

)" + describe_options(bake_recipe_schema()) +
                          R"(
Returns a dict of arrays: vertices (n, 3), faces (m, corners), or a list where they have different numbers of corners, normals
(n, 3), colors (n, 3), in linear light, noise (n,), the recipe's properties, such as roughness and height, and those that keep names.
A recipe that refines the mesh has more vertices than there were: those come first, in their order. Raises ValueError.)")
                 .c_str());
  module.def("curvature", &measure, "vertices"_a, "faces"_a, py::kw_only(), "smooth"_a = 2,
             "smooth_radius"_a = 0.0, "threads"_a = py::none(), "progress"_a = py::none(),
             R"(curvature(vertices, faces, *, smooth=2, smooth_radius=0.0, threads=None, progress=None)
--

The curvature of a mesh at its vertices, 1 / world unit, positive where the surface bulges out along its normals: a sphere of radius R
has k1 = k2 = 1 / R.

vertices, faces : as of bake()
smooth : int, 0 to 10000, rounds
    Of smoothing with the neighbours.
smooth_radius : float, at least 0, world units
    Of smoothing that does not depend on the mesh.
threads, progress
    As of Noise.

Returns a dict of float64 arrays: k1 >= k2 (n,), their directions k1_direction and k2_direction (n, 3), unit tangents, and mean and
gaussian (n,).)");
  add_surface_noise(module);
}

}  // namespace solidnoise::python
