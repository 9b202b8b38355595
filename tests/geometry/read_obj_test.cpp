#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "support/message_of.h"

namespace solidnoise::read_obj_test {
namespace {

MeshReading read(const std::string& text) {
  return read_mesh(text, MeshFormat::obj, "mesh.obj");
}

std::string refusal(const std::string& text) {
  return message_of<std::runtime_error>([&] { read(text); });
}

std::vector<std::uint32_t> face(const PolygonMesh& mesh, std::size_t index) {
  const auto corners = mesh.face(index);
  return {corners.begin(), corners.end()};
}

TEST(ReadObj, ReadsPositionsAndFacesAndSkipsEverythingElse) {
  const MeshReading reading = read(
      "# a comment\n"
      "mtllib x.mtl\no thing\n"
      "v 0 0 0\nv 1.5e0 0 0 1.0\nv 1 +1 0 # with a comment\r\n"
      "vt 0 0\nvn 0 0 1\ns off\nusemtl x\nl 1 2\n"
      "\tf 1/1/1 2//1 3/1\n");
  ASSERT_EQ(reading.mesh.positions.size(), 3u);
  EXPECT_EQ(reading.mesh.positions[1], Vec<3>(1.5, 0, 0));
  EXPECT_EQ(reading.mesh.positions[2], Vec<3>(1, 1, 0));
  ASSERT_EQ(reading.mesh.face_count(), 1u);
  EXPECT_EQ(face(reading.mesh, 0), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(reading.mesh.properties.empty());
  EXPECT_EQ(reading.comments, std::vector<std::string>{"a comment"});
  EXPECT_EQ(reading.notes, (std::vector<std::string>{
                               "normals of the faces' corners are dropped", "texture coordinates are dropped",
                               "1 lines or points are dropped", "groups and materials are dropped"}));
}

TEST(ReadObj, KeepsPolygonsAndCutsThemIntoFansOnDemand) {
  const MeshReading reading = read("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5");
  ASSERT_EQ(reading.mesh.face_count(), 1u);
  EXPECT_EQ(triangulate(reading.mesh), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(ReadObj, CountsNegativeIndicesBackFromTheLastVertexSoFar) {
  const MeshReading reading = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 1 -3");
  ASSERT_EQ(reading.mesh.face_count(), 2u);
  EXPECT_EQ(face(reading.mesh, 0), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(face(reading.mesh, 1), (std::vector<std::uint32_t>{3, 0, 1}));
}

TEST(ReadObj, JoinsLinesThatEndWithABackslash) {
  const MeshReading reading = read("v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nf 1 2 \\\r\n3\n");
  EXPECT_EQ(reading.mesh.face_count(), 1u);
  // Comments end with their line, whatever its last character.
  const MeshReading commented = read("# C:\\models\\\nv 0 0 0\nv 1 0 0 # \\\nv 0 1 \\\n0 # \\\nf 1 2 3\n");
  EXPECT_EQ(commented.mesh.positions.size(), 3u);
  EXPECT_EQ(commented.mesh.face_count(), 1u);
  // The line that is named is the last of those joined.
  EXPECT_EQ(refusal("v 0 \\\n0 \\\nx\n"), "mesh.obj:3: vertex 1: 'x' is not a finite number");
}

TEST(ReadObj, KeepsColoursAfterThePositions) {
  const PolygonMesh floats = read("v 0 0 0 0 0.25 1\nv 1 0 0 1 1 1\nv 0 1 0 0 0 0\nf 1 2 3\n").mesh;
  ASSERT_EQ(floats.properties.size(), 3u);
  EXPECT_EQ(floats.properties[1].name, "green");
  EXPECT_EQ(floats.properties[1].type, ScalarType::float32);
  EXPECT_EQ(floats.properties[1].values, (std::vector<double>{0.25, 1, 0}));

  // Whole numbers above 1 are 8-bit colours; a vertex without a colour is white.
  const MeshReading bytes = read("v 0 0 0\nv 1 0 0 255 128 0 7\nv 0 1 0 1 2 3 4\nf 1 2 3\n");
  ASSERT_EQ(bytes.mesh.properties.size(), 4u);
  EXPECT_EQ(bytes.mesh.properties[0].type, ScalarType::uint8);
  EXPECT_EQ(bytes.mesh.properties[1].values, (std::vector<double>{255, 128, 2}));
  EXPECT_EQ(bytes.mesh.properties[3].name, "alpha");
  EXPECT_EQ(bytes.mesh.properties[3].values, (std::vector<double>{255, 7, 4}));
  EXPECT_EQ(bytes.notes, std::vector<std::string>{"1 vertices without a colour are white"});
}

TEST(ReadObj, KeepsNormalsThatBelongToVertices) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\n";
  const PolygonMesh mesh = read(vertices + "f 1//1 2//2 -1//-1\n").mesh;
  ASSERT_EQ(mesh.properties.size(), 3u);
  EXPECT_EQ(mesh.properties[2].name, "nz");
  EXPECT_EQ(mesh.properties[2].values, (std::vector<double>{1, 0, 0}));
  EXPECT_TRUE(read(vertices + "f 1//1 2//1 3//3\n").mesh.properties.empty());
}

TEST(ReadObj, KeepsThePrecisionThatTheDigitsHave) {
  const std::string rest = " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(read("v 0.0123456789" + rest).mesh.position_type, ScalarType::float32);
  EXPECT_EQ(read("v 123456.7890" + rest).mesh.position_type, ScalarType::float64);
  EXPECT_EQ(read("v 1e39" + rest).mesh.position_type, ScalarType::float64);
  EXPECT_EQ(read("v 123456.7890" + rest).mesh.positions[0].x, 123456.789);
  EXPECT_EQ(read("v -1e-999" + rest).mesh.positions[0].x, 0.0);
}

TEST(ReadObj, NamesLineAndElementOfAnError) {
  EXPECT_EQ(refusal("v 0 0 0\nv 1 x 0\n"), "mesh.obj:2: vertex 2: 'x' is not a finite number");
  EXPECT_EQ(refusal("v nan 0 0\n"), "mesh.obj:1: vertex 1: 'nan' is not a finite number");
  EXPECT_EQ(refusal("v 0 -inf 0\n"), "mesh.obj:1: vertex 1: '-inf' is not a finite number");
  EXPECT_EQ(refusal("v 1e999 0 0\n"), "mesh.obj:1: vertex 1: '1e999' is not a finite number");
  EXPECT_EQ(refusal("v 1,5 0 0\n"), "mesh.obj:1: vertex 1: '1,5' is not a finite number");
  EXPECT_EQ(refusal("v 1 2\n"), "mesh.obj:1: vertex 1: it needs three coordinates");
  EXPECT_EQ(refusal("v 1 2 3 4 5 6 7 8\n"), "mesh.obj:1: vertex 1: it has more than seven numbers");
  EXPECT_EQ(refusal("v 0 0 0\nf\n"), "mesh.obj:2: face 1: it has no vertices");
  EXPECT_EQ(refusal("v 0 0 0\n\nf 1 1 2\n"),
            "mesh.obj:3: face 1: vertex index 2 is out of range, 1 vertices so far");
  EXPECT_EQ(refusal("v 0 0 0\nf 1 1 1\nf 1 1 -2\n"),
            "mesh.obj:3: face 2: vertex index -2 is out of range, 1 vertices so far");
  EXPECT_EQ(refusal("f 0 1 2\n"), "mesh.obj:1: face 1: vertex index 0 is out of range, 0 vertices so far");
  EXPECT_EQ(refusal("f a/1 2 3\n"), "mesh.obj:1: face 1: 'a' is not a vertex index");
  EXPECT_EQ(refusal("f 99999999999999999999 2 3\n"),
            "mesh.obj:1: face 1: '99999999999999999999' is not a vertex index");
  EXPECT_EQ(refusal("vn 0 0\n"), "mesh.obj:1: a normal needs three numbers");
}

}  // namespace
}  // namespace solidnoise::read_obj_test
