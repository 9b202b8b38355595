#include <filesystem>
#include <fstream>
#include <iostream>

#include "solidnoise/geometry/mesh_file.h"
#include "support/sample_meshes.h"

// write_fuzz_seeds FOLDER: writes a small file of each kind into FOLDER/ply, FOLDER/obj, ...
int main(int argc, char** argv) {
  using namespace solidnoise;
  if (argc != 2) {
    std::cerr << "write_fuzz_seeds: a folder is needed\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  for (const char* name : {"ply", "obj", "off", "stl", "om", "glb", "gltf"})
    std::filesystem::create_directories(folder / name);
  const PolygonMesh mesh = awkward_mesh();
  const MeshWriteOptions replace{.existing = Existing::replace};
  for (const auto& [name, encoding] :
       {std::pair{"text.ply", PlyEncoding::ascii}, std::pair{"little.ply", PlyEncoding::binary_little_endian},
        std::pair{"big.ply", PlyEncoding::binary_big_endian}}) {
    write_mesh(folder / "ply" / name, mesh, {.ply = encoding, .existing = Existing::replace});
  }
  write_mesh(folder / "obj" / "mesh.obj", mesh, replace);
  write_mesh(folder / "off" / "mesh.off", mesh, replace);
  write_mesh(folder / "om" / "mesh.om", mesh, replace);
  write_mesh(folder / "glb" / "mesh.glb", mesh, replace);
  std::ofstream(folder / "gltf" / "scene.gltf", std::ios::binary) << gltf_scene();
  std::ofstream(folder / "om" / "halfedges.om", std::ios::binary) << om_triangle();
  std::ofstream(folder / "stl" / "text.stl", std::ios::binary) << stl_text();
  std::ofstream(folder / "stl" / "binary.stl", std::ios::binary) << stl_binary();
}
