// bake_mesh IN OUT: reads a mesh with OpenMesh, bakes noise, refines the mesh with one of OpenMesh's
// subdividers, bakes again, and writes it with OpenMesh. Solid noise depends on the position alone, and
// splitting edges leaves vertices where they are: those that were there at first have the same noise, to the
// last bit.
#include <iostream>
#include <vector>

// MeshIO.hh comes before the kernels.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LongestEdgeT.hh>

#include "solidnoise/mesh/openmesh.h"

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

std::vector<float> noise_of(const Mesh& mesh) {
  OpenMesh::VPropHandleT<float> noise;
  mesh.get_property_handle(noise, "noise");
  std::vector<float> values;
  for (const auto vertex : mesh.vertices()) values.push_back(mesh.property(noise, vertex));
  return values;
}

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 3 || !OpenMesh::IO::read_mesh(mesh, argv[1])) {
    std::cerr << "usage: bake_mesh IN OUT\n";
    return 2;
  }
  solidnoise::BakeRecipe recipe;
  recipe.noise.kind = solidnoise::SurfaceNoiseKind::solid;
  recipe.frequency = solidnoise::ParameterRange{4.0, 4.0};
  recipe.ramp = "marble";
  solidnoise::bake(mesh, recipe);
  const std::vector<float> before = noise_of(mesh);

  OpenMesh::Subdivider::Uniform::LongestEdgeT<Mesh, double> subdivider;
  subdivider.set_max_edge_length(0.05);
  subdivider.attach(mesh);
  subdivider(1);
  subdivider.detach();
  solidnoise::bake(mesh, recipe);
  const std::vector<float> after = noise_of(mesh);

  std::size_t changed = 0;
  for (std::size_t v = 0; v < before.size(); ++v) changed += before[v] != after[v] ? 1 : 0;
  std::cout << before.size() << " vertices, " << after.size() << " when refined; " << changed
            << " of the old ones have changed\n";
  const bool written = OpenMesh::IO::write_mesh(mesh, argv[2], OpenMesh::IO::Options::VertexColor);
  return written && changed == 0 && after.size() > before.size() ? 0 : 1;
}
