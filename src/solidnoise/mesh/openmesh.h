#pragma once

#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/BaseKernel.hh>
#include <OpenMesh/Core/Utils/color_cast.hh>

#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_noise.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/surface_mesh.h"

// Noise on the meshes of OpenMesh themselves: TriMesh_ArrayKernelT and PolyMesh_ArrayKernelT of any traits,
// with points of float or double and colours of three or four bytes or floats. Vertices and faces stay as
// they are; results are properties of the vertices, which are made where they are not there, and marked to be
// stored. What is deleted but not yet collected is no part of the surface. Points of any type are read once,
// into doubles, with the faces: curvature and noise are computed in double precision. One mesh is one
// thread's at a time.
namespace solidnoise {

template <typename Mesh>
concept OpenMeshMesh = std::derived_from<Mesh, OpenMesh::BaseKernel> && requires {
  typename Mesh::Point;
};

// Bakes a recipe: sets the vertices' colours, which are requested where there are none, the property `noise`
// (float), those of the recipe, such as `height`, and those that `keep` names (float; `direction`, `gradient`
// and `curl`: Vec3f), see keepable_names(). A recipe that displaces moves the points, and sets vertex normals
// where the mesh has them; what is baked after that is baked at the new points. Returns the moments of the
// noise.
//
// A frequency that the recipe leaves open suits the mesh: give one if what is baked shall stay the same when
// the mesh is refined. Throws std::invalid_argument: a recipe that refines, for which OpenMesh has
// subdividers; a property to be set that is there with values of another type; what plan_bake() and bake()
// throw. Cancelled.
template <OpenMeshMesh Mesh>
Moments bake(Mesh& mesh, const BakeRecipe& recipe, const std::vector<std::string>& keep = {},
             Progress* progress = nullptr);

// Measures the curvature (measure_curvature): sets the properties `k1` and `k2` (double, 1/world unit) and
// `k1_direction` (Vec3d, of length 1).
template <OpenMeshMesh Mesh>
void curvature(Mesh& mesh, const CurvatureOptions& options = {});

// A number that vertices have: one for all, or a vertex property of floats or doubles, by its name.
using MeshNumber = std::variant<double, std::string>;

struct MeshNoiseParameters {
  MeshNumber frequency = 8.0;  // cycles per world unit; > 0
  MeshNumber bandwidth = 1.0;  // octaves; 0.1 to 4
  MeshNumber magnitude = 1.0;  // standard deviation; >= 0
  // Where has_direction(): a vertex property of Vec3f or Vec3d, such as k1_direction. See BakeVertices.
  std::string direction = {};
};

// Evaluates a noise at all vertices (bake_noise) and sets the property `noise` (float). Throws
// std::invalid_argument: a property that is not there; what bake_noise() throws. Cancelled.
template <OpenMeshMesh Mesh>
void bake_noise(Mesh& mesh, const SurfaceNoiseRecipe& recipe, const MeshNoiseParameters& parameters = {},
                Progress* progress = nullptr);

// The vertices and the faces that are not deleted, in their order.
template <OpenMeshMesh Mesh>
PolygonMesh polygon_mesh(const Mesh& mesh);

// plan_bake() and bake() for a mesh that keeps its vertices.
BakedMesh bake_in_place(PolygonMesh mesh, const BakeRecipe& recipe, const std::vector<std::string>& keep,
                        Progress* progress);

namespace openmesh {

// Sets a vertex property; `value` gives that of each vertex that is not deleted, counted from 0.
template <typename Value, typename Mesh, typename Function>
void set_property(Mesh& mesh, const std::string& name, const Function& value) {
  OpenMesh::VPropHandleT<Value> handle;
  if (!mesh.get_property_handle(handle, name)) {
    if (mesh._get_vprop(name))
      throw std::invalid_argument("the mesh has a vertex property " + name + " of another type");
    mesh.add_property(handle, name);
    mesh.property(handle).set_persistent(true);
  }
  std::size_t number = 0;
  for (const auto vertex : mesh.vertices()) mesh.property(handle, vertex) = value(number++);
}

// Calls `take` with the values of the vertex property of this name, of vertices that are not deleted, if it
// is of the type. Returns whether it is.
template <typename Value, typename Mesh, typename Function>
bool take_property(const Mesh& mesh, const std::string& name, const Function& take) {
  OpenMesh::VPropHandleT<Value> handle;
  if (!mesh.get_property_handle(handle, name)) return false;
  for (const auto vertex : mesh.vertices()) take(mesh.property(handle, vertex));
  return true;
}

template <typename Number, typename Mesh>
std::vector<Number> numbers(const Mesh& mesh, const std::string& field, const std::string& name) {
  std::vector<Number> values;
  values.reserve(mesh.n_vertices());
  const auto take = [&](auto value) { values.push_back(static_cast<Number>(value)); };
  if (take_property<float>(mesh, name, take) || take_property<double>(mesh, name, take)) return values;
  throw std::invalid_argument(field + " is " + name +
                              "; the mesh has no vertex property of floats or doubles so named");
}

template <typename Mesh>
VertexNumber vertex_number(const Mesh& mesh, const std::string& field, const MeshNumber& number) {
  if (const double* const constant = std::get_if<double>(&number)) return {*constant, {}};
  constexpr double kTypical = 1.0;  // of any vertices: none depends on the others
  return {kTypical, numbers<float>(mesh, field, std::get<std::string>(number))};
}

template <typename Mesh>
std::vector<Vec<3>> vectors(const Mesh& mesh, const std::string& field, const std::string& name) {
  std::vector<Vec<3>> values;
  const auto take = [&](const auto& value) { values.push_back({value[0], value[1], value[2]}); };
  if (take_property<OpenMesh::Vec3f>(mesh, name, take) || take_property<OpenMesh::Vec3d>(mesh, name, take)) {
    return values;
  }
  throw std::invalid_argument(field + " is " + name +
                              "; the mesh has no vertex property of Vec3f or Vec3d so named");
}

}  // namespace openmesh

template <OpenMeshMesh Mesh>
PolygonMesh polygon_mesh(const Mesh& mesh) {
  PolygonMesh result;
  result.positions.reserve(mesh.n_vertices());
  std::vector<std::uint32_t> numbers(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    numbers[static_cast<std::size_t>(vertex.idx())] = static_cast<std::uint32_t>(result.positions.size());
    const auto& point = mesh.point(vertex);
    result.positions.push_back({point[0], point[1], point[2]});
  }
  std::vector<std::uint32_t> corners;
  for (const auto face : mesh.faces()) {
    corners.clear();
    for (const auto vertex : mesh.fv_range(face))
      corners.push_back(numbers[static_cast<std::size_t>(vertex.idx())]);
    result.add_face(corners);
  }
  return result;
}

template <OpenMeshMesh Mesh>
Moments bake(Mesh& mesh, const BakeRecipe& recipe, const std::vector<std::string>& keep, Progress* progress) {
  PolygonMesh polygons = polygon_mesh(mesh);
  if (recipe.steers() && recipe.by.source == SteeringSource::attribute) {
    const std::string& name = recipe.by.attribute;
    polygons.set_property({name, ScalarType::float64, openmesh::numbers<double>(mesh, "attribute", name)});
  }
  const BakedMesh baked = bake_in_place(std::move(polygons), recipe, keep, progress);
  const auto values = [&](const std::string& name) -> const std::vector<double>& {
    return baked.mesh.property(name)->values;
  };
  const auto set = [&](const std::string& name) {
    if (baked.mesh.property(name)) {
      const std::vector<double>& numbers = values(name);
      openmesh::set_property<float>(mesh, name,
                                    [&](std::size_t v) { return static_cast<float>(numbers[v]); });
      return;
    }
    const auto& x = values(name + "_x");
    const auto& y = values(name + "_y");
    const auto& z = values(name + "_z");
    openmesh::set_property<OpenMesh::Vec3f>(
        mesh, name, [&](std::size_t v) { return OpenMesh::Vec3f(OpenMesh::Vec3d(x[v], y[v], z[v])); });
  };
  set("noise");
  for (const auto& [name, layer] : recipe.properties) set(name);
  for (const std::string& name : keep) set(name);

  const auto& red = values("red");
  const auto& green = values("green");
  const auto& blue = values("blue");
  if (!mesh.has_vertex_colors()) mesh.request_vertex_colors();
  std::size_t number = 0;
  for (const auto vertex : mesh.vertices()) {
    const std::size_t v = number++;
    const OpenMesh::Vec3uc color(OpenMesh::Vec3d(red[v], green[v], blue[v]));
    mesh.set_color(vertex, OpenMesh::color_cast<typename Mesh::Color>(color));
    if (recipe.displace == 0.0) continue;
    const auto vector = [](const Vec<3>& from) { return OpenMesh::Vec3d(from.x, from.y, from.z); };
    mesh.set_point(vertex, typename Mesh::Point(vector(baked.mesh.positions[v])));
    if (mesh.has_vertex_normals()) mesh.set_normal(vertex, typename Mesh::Normal(vector(baked.normals[v])));
  }
  return baked.moments;
}

template <OpenMeshMesh Mesh>
void curvature(Mesh& mesh, const CurvatureOptions& options) {
  const Curvature measured = measure_curvature(SurfaceMesh(polygon_mesh(mesh)), options);
  openmesh::set_property<double>(mesh, "k1", [&](std::size_t v) { return measured.k1[v]; });
  openmesh::set_property<double>(mesh, "k2", [&](std::size_t v) { return measured.k2[v]; });
  openmesh::set_property<OpenMesh::Vec3d>(mesh, "k1_direction", [&](std::size_t v) {
    const Vec<3>& direction = measured.k1_direction[v];
    return OpenMesh::Vec3d(direction.x, direction.y, direction.z);
  });
}

template <OpenMeshMesh Mesh>
void bake_noise(Mesh& mesh, const SurfaceNoiseRecipe& recipe, const MeshNoiseParameters& parameters,
                Progress* progress) {
  const PolygonMesh polygons = polygon_mesh(mesh);
  const SurfaceMesh surface(polygons);
  const std::vector<Vec<3>> normals = surface.to_vertices(surface.normals());
  BakeVertices vertices{polygons.positions,
                        normals,
                        openmesh::vertex_number(mesh, "frequency", parameters.frequency),
                        openmesh::vertex_number(mesh, "bandwidth", parameters.bandwidth),
                        openmesh::vertex_number(mesh, "magnitude", parameters.magnitude),
                        {}};
  std::vector<Vec<3>> directions;
  if (has_direction(recipe)) directions = openmesh::vectors(mesh, "direction", parameters.direction);
  vertices.directions = directions;
  const std::vector<float> values = bake_noise(recipe, vertices, progress);
  openmesh::set_property<float>(mesh, "noise", [&](std::size_t v) { return values[v]; });
}

}  // namespace solidnoise
