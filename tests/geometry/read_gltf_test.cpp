#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/rewrite_mesh.h"
#include "support/mesh_text.h"
#include "support/message_of.h"
#include "support/sample_meshes.h"

namespace solidnoise::read_gltf_test {
namespace {

using nlohmann::json;

std::string refusal(const json& scene) {
  return message_of<std::runtime_error>([&] { read_mesh(scene.dump(), MeshFormat::gltf, "scene.gltf"); });
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string rewritten(const std::string& bytes, MeshFormat format, const PolygonMesh& mesh,
                      const MeshWriteOptions& options = {}) {
  std::ostringstream stream;
  rewrite_mesh(stream, bytes, format, "scene", mesh, options);
  return stream.str();
}

json text_of(const std::string& glb) {
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(glb[i])}; };
  return json::parse(glb.substr(20, byte(12) | byte(13) << 8 | byte(14) << 16));
}

// The scene's square with colours and noise.
PolygonMesh baked_square() {
  PolygonMesh mesh = read_mesh(gltf_scene(), MeshFormat::gltf, "scene").mesh;
  for (const char* const name : {"red", "green", "blue"})
    mesh.set_property({name, ScalarType::uint8, {0.0, 64.0, 128.0, 255.0}});
  mesh.set_property({"noise", ScalarType::float32, {0.5, -1.0, 2.0, -0.25}});
  return mesh;
}

TEST(ReadGltf, PutsMeshesWhereTheirFirstNodesDo) {
  const MeshReading reading = read_mesh(gltf_scene(), MeshFormat::gltf, "scene");
  EXPECT_EQ(reading.mesh.positions, (std::vector<Vec<3>>{{0, 0, 5}, {2, 0, 5}, {2, 2, 5}, {0, 2, 5}}));
  EXPECT_EQ(reading.mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(reading.mesh.property("s")->values, (std::vector<double>{0, 1, 1, 0}));
  EXPECT_EQ(reading.mesh.property("t")->values, (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(reading.comments, std::vector<std::string>{"made by hand"});
  ASSERT_EQ(reading.notes.size(), 2u);
  EXPECT_TRUE(has(reading.notes[0], "3 nodes, 1 materials, 1 animations")) << reading.notes[0];
  EXPECT_TRUE(has(reading.notes[1], "meshes[0] is that of 2 nodes")) << reading.notes[1];
}

// glTF 2.0, 3.7.4: where the determinant of a node's transform is negative, triangles are wound the other
// way.
TEST(ReadGltf, KeepsFacesOutsideOutWhereANodeMirrorsThem) {
  json scene = json::parse(gltf_scene());
  scene["nodes"][1]["scale"] = {-2, 2, 2};
  const PolygonMesh mesh = read_mesh(scene.dump(), MeshFormat::gltf, "scene").mesh;
  EXPECT_EQ(mesh.positions[1], Vec<3>(-2, 0, 5));
  EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2}));
}

TEST(ReadGltf, KeepsTheTextureCoordinatesOfEachPrimitive) {
  json scene = json::parse(gltf_scene());
  json& primitives = scene["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[0]["attributes"].erase("TEXCOORD_0");
  PolygonMesh mesh = read_mesh(scene.dump(), MeshFormat::gltf, "scene").mesh;
  ASSERT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(mesh.property("s")->values[5], 1.0);
  EXPECT_FALSE(mesh.property("s")->values[1] == 1.0);
  mesh.set_property({"noise", ScalarType::float32, std::vector<double>(8, 0.5)});
  EXPECT_EQ(
      read_mesh(rewritten(scene.dump(), MeshFormat::gltf, mesh), MeshFormat::glb, "scene").mesh.positions,
      mesh.positions);
}

TEST(ReadGltf, ReadsWhatWeWrite) {
  PolygonMesh mesh = awkward_mesh();
  mesh.add_face(std::array{0u, 1u, 2u});
  const std::string bytes = written(mesh, MeshFormat::glb, {.comments = {"one", "two"}});
  const MeshReading reading = read_mesh(bytes, MeshFormat::glb, "mesh");
  EXPECT_EQ(reading.mesh.positions.size(), mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(reading.mesh.positions[v][axis],
                static_cast<double>(static_cast<float>(mesh.positions[v][axis])));
    }
  }
  EXPECT_EQ(reading.mesh.face_count(), triangulate(mesh).size());
  EXPECT_EQ(reading.comments, (std::vector<std::string>{"one", "two"}));
}

TEST(ReadGltf, CutsStripsAndFans) {
  json scene = json::parse(gltf_scene());
  json& primitive = scene["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  primitive["mode"] = 5;
  EXPECT_EQ(read_mesh(scene.dump(), MeshFormat::gltf, "s").mesh.corners,
            (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
  primitive["mode"] = 6;
  EXPECT_EQ(read_mesh(scene.dump(), MeshFormat::gltf, "s").mesh.corners,
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(ReadGltf, RefusesInOneLine) {
  const auto changed = [](const char* place, const json& value) {
    json scene = json::parse(gltf_scene());
    scene[json::json_pointer(place)] = value;
    return refusal(scene);
  };
  EXPECT_TRUE(has(changed("/asset/version", "1.0"), "asset.version must be"));
  EXPECT_TRUE(
      has(changed("/accessors/0/bufferView", 9), "accessors[0].bufferView must be a whole number below 5"));
  EXPECT_TRUE(has(changed("/accessors/0/count", 5), "accessors[0] has more numbers than bytes"));
  EXPECT_TRUE(has(changed("/accessors/0/sparse", json::object()), "is sparse"));
  EXPECT_TRUE(has(changed("/accessors/1/count", 3), "accessors[1] must be 4 VEC2"));
  EXPECT_TRUE(has(changed("/bufferViews/0/byteLength", 1000), "more numbers than bytes"));
  EXPECT_TRUE(has(changed("/bufferViews/2/byteOffset", 81), "index"));
  EXPECT_TRUE(has(changed("/buffers/0/byteLength", 1 << 20), "scene.gltf: "));
  EXPECT_TRUE(has(changed("/buffers/0/uri", "../secret.bin"), "it must be the name of a file beside it"));
  EXPECT_TRUE(has(changed("/buffers/0/uri", "missing.bin"), "missing.bin"));
  EXPECT_TRUE(has(changed("/nodes/1/children", json{0}), "nodes[0] is its own ancestor"));
  EXPECT_TRUE(has(changed("/nodes/2/children", json{1}), "nodes[1] has two parents"));
  EXPECT_TRUE(has(changed("/nodes/1/scale", json{1, 2}), "nodes[1].scale must be 3 numbers"));
  EXPECT_TRUE(has(changed("/extensionsRequired", json{"KHR_draco_mesh_compression"}), "are compressed"));
  EXPECT_TRUE(has(changed("/extensionsRequired", json{"KHR_evil"}), "it requires KHR_evil"));
  EXPECT_TRUE(has(changed("/asset/minVersion", "9.0"), "asset.minVersion is 9.0"));
  EXPECT_TRUE(
      has(message_of<std::runtime_error>([] { read_mesh("{}x", MeshFormat::gltf, "a"); }), "no JSON object"));
  const std::string deep = std::string(R"({"asset":{"version":"2.0"},"extras":)") + std::string(5000, '[');
  EXPECT_TRUE(
      has(message_of<std::runtime_error>([&] { read_mesh(deep, MeshFormat::gltf, "a"); }), "64 deep"));
  EXPECT_TRUE(has(message_of<std::runtime_error>([] { read_mesh("glTF", MeshFormat::glb, "a"); }),
                  "a: it is no .glb"));
}

TEST(RewriteGltf, KeepsAllButColorsAndNumbers) {
  const std::string glb = rewritten(gltf_scene(), MeshFormat::gltf, baked_square(), {.comments = {"recipe"}});
  const json before = json::parse(gltf_scene());
  json after = text_of(glb);
  const json& attributes = after["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(attributes["POSITION"], 0);
  const json noise = after["accessors"][attributes["_NOISE"].get<std::size_t>()];
  const json color = after["accessors"][attributes["COLOR_0"].get<std::size_t>()];
  EXPECT_EQ(noise["type"], "SCALAR");
  EXPECT_EQ(color["type"], "VEC4");
  EXPECT_EQ(color["normalized"], true);
  for (const char* const key : {"nodes", "materials", "animations", "scenes", "extensionsUsed"})
    EXPECT_EQ(after[key], before[key]) << key;
  EXPECT_EQ(after["asset"]["extras"]["comments"], json{"recipe"});
  EXPECT_EQ(after["buffers"][1], before["buffers"][0]);
  EXPECT_EQ(after["bufferViews"][0]["buffer"], 1);
  // Again, of a .glb: the same mesh, and what was added stays in its place.
  const MeshReading reading = read_mesh(glb, MeshFormat::glb, "scene");
  EXPECT_EQ(reading.mesh.positions, baked_square().positions);
  const std::string again = rewritten(glb, MeshFormat::glb, baked_square());
  EXPECT_EQ(text_of(again)["buffers"].size(), 2u);
  EXPECT_EQ(text_of(again)["accessors"].size(), before["accessors"].size() + 4);
  PolygonMesh other = baked_square();
  other.positions.pop_back();
  EXPECT_THROW(rewritten(glb, MeshFormat::glb, other), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::read_gltf_test
