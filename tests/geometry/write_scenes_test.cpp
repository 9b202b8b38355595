#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/scene_values.h"
#include "support/mesh_text.h"

namespace solidnoise::write_scenes_test {
namespace {

PolygonMesh square() {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
  mesh.set_property(
      {"noise", ScalarType::float32, {0.0, 0.5, std::numeric_limits<double>::quiet_NaN(), -1e300}});
  return mesh;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof(number));
  return number;
}

TEST(WriteGlb, SaysItsSizesAndHasNumbersThatAreFinite) {
  const std::string glb = written(square(), MeshFormat::glb);
  EXPECT_EQ(number_at(glb, 8), glb.size());
  const std::uint32_t text = number_at(glb, 12);
  EXPECT_EQ(text % 4, 0u);
  EXPECT_EQ(number_at(glb, 20 + text), glb.size() - 28 - text);
  // Positions, normals and the noise of four vertices, corners of two triangles.
  const std::size_t noise = 28 + text + 4 * (3 + 3) * sizeof(float);
  ASSERT_EQ(glb.size(), noise + 4 * sizeof(float) + 6 * sizeof(std::uint32_t));
  float values[4];
  std::memcpy(values, glb.data() + noise, sizeof(values));
  EXPECT_EQ(values[1], 0.5f);
  EXPECT_EQ(values[2], 0.0f);
  EXPECT_EQ(values[3], std::numeric_limits<float>::lowest());
}

TEST(WriteGlb, IsOfPointsWhereThereAreNoFaces) {
  PolygonMesh points = square();
  points.face_starts = {0};
  points.corners.clear();
  const std::string glb = written(points, MeshFormat::glb);
  EXPECT_NE(glb.find(R"("mode":0)"), std::string::npos);
  EXPECT_EQ(glb.find("NORMAL"), std::string::npos);
  EXPECT_NE(written(points, MeshFormat::usda).find("def Points \"mesh\""), std::string::npos);
}

TEST(WriteScenes, EscapeWhatCommentsSay) {
  const MeshWriteOptions options{.comments = {"a \"b\" \\ \n\x01 caf\xe9"}};
  const std::string escaped = R"("a \"b\" \\    caf?")";
  EXPECT_NE(written(square(), MeshFormat::glb, options).find(escaped), std::string::npos);
  EXPECT_NE(written(square(), MeshFormat::usda, options).find(escaped), std::string::npos);
}

TEST(WriteScenes, RefuseWhatTheyCannotHold) {
  PolygonMesh far = square();
  far.positions[1].x = 1e39;
  PolygonMesh twice = square();
  twice.set_property({"Noise", ScalarType::float32, {0, 0, 0, 0}});
  twice.set_property({"a-b", ScalarType::float32, {0, 0, 0, 0}});
  twice.set_property({"a.b", ScalarType::float32, {0, 0, 0, 0}});
  for (const MeshFormat format : {MeshFormat::glb, MeshFormat::usda}) {
    EXPECT_THROW(written(far, format), std::invalid_argument);
    EXPECT_THROW(written(twice, format), std::invalid_argument);
    EXPECT_THROW(read_mesh("glTF", format, "x"), std::runtime_error);
  }
}

TEST(UnitNormals, AreTheMeshsOwnOrThoseOfItsFaces) {
  PolygonMesh mesh = square();
  EXPECT_EQ(unit_normals(mesh)[2], Vec<3>(0, 0, 1));
  mesh.set_property({"nx", ScalarType::float32, {2, 0, 0, 0}});
  mesh.set_property({"ny", ScalarType::float32, {0, 0, 0, 0}});
  mesh.set_property({"nz", ScalarType::float32, {0, 0, -3, 0}});
  const std::vector<Vec<3>> normals = unit_normals(mesh);
  EXPECT_EQ(normals[0], Vec<3>(1, 0, 0));
  EXPECT_EQ(normals[1], Vec<3>(0, 0, 1));  // its own has no direction
  EXPECT_EQ(normals[2], Vec<3>(0, 0, -1));
}

// sRGB's own pairs: its darkest step, where the curve begins, the middle and the ends.
TEST(LinearColor, IsThatOfTheStandard) {
  const VertexProperty red{"red", ScalarType::uint8, {0, 1, 188, 255}};
  EXPECT_EQ(linear_color(red, 0), 0.0);
  EXPECT_NEAR(linear_color(red, 1), 1.0 / (255.0 * 12.92), 1e-9);  // a float's rounding
  EXPECT_NEAR(linear_color(red, 2), 0.5029, 1e-4);                 // 0.7372549 by hand, to four digits
  EXPECT_EQ(linear_color(red, 3), 1.0);
  const VertexProperty alpha{"alpha", ScalarType::uint8, {51}};
  EXPECT_NEAR(linear_color(alpha, 0), 0.2, 1e-7);
}

}  // namespace
}  // namespace solidnoise::write_scenes_test
