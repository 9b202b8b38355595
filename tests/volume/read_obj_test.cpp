#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/volume/triangle_mesh.h"
#include "support/message_of.h"

namespace solidnoise {
namespace {

TriangleMesh parse(const std::string& text) {
  std::istringstream stream(text);
  return read_obj(stream, "mesh.obj");
}

std::string refusal(const std::string& text) {
  return message_of<std::runtime_error>([&] { parse(text); });
}

TEST(ReadObj, ReadsPositionsAndFacesAndSkipsEverythingElse) {
  const TriangleMesh mesh = parse(
      "# a comment\n"
      "mtllib x.mtl\no thing\n"
      "v 0 0 0\nv 1.5e0 0 0 1.0\nv 1 1 0 0.5 0.5 0.5 # with a colour\r\n"
      "vt 0 0\nvn 0 0 1\ns off\nusemtl x\n"
      "\tf 1/1/1 2//1 3/1\n");
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[1], Vec<3>(1.5, 0, 0));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST(ReadObj, CutsPolygonsIntoFans) {
  const TriangleMesh mesh = parse("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[2], (std::array<std::uint32_t, 3>{0, 3, 4}));
}

TEST(ReadObj, CountsNegativeIndicesBackFromTheLastVertexSoFar) {
  const TriangleMesh mesh = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 1 -3");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{3, 0, 1}));
}

TEST(ReadObj, JoinsLinesThatEndWithABackslash) {
  const TriangleMesh mesh = parse("v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nf 1 2 \\\r\n3\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(ReadObj, NamesTheLineOfAnError) {
  EXPECT_EQ(refusal("v 0 0 0\nv 1 x 0\n"), "mesh.obj:2: 'x' is not a finite number");
  EXPECT_EQ(refusal("v nan 0 0\n"), "mesh.obj:1: 'nan' is not a finite number");
  EXPECT_EQ(refusal("v 1e999 0 0\n"), "mesh.obj:1: '1e999' is not a finite number");
  EXPECT_EQ(refusal("v 1 2\n"), "mesh.obj:1: a vertex needs three coordinates");
  EXPECT_EQ(refusal("v 0 0 0\nf 1 1\n"), "mesh.obj:2: a face needs three vertices, this one has 2");
  EXPECT_EQ(refusal("v 0 0 0\n\nf 1 1 2\n"), "mesh.obj:3: vertex index 2 is out of range, 1 vertices so far");
  EXPECT_EQ(refusal("v 0 0 0\nf 1 1 -2\n"), "mesh.obj:2: vertex index -2 is out of range, 1 vertices so far");
  EXPECT_EQ(refusal("f 0 1 2\n"), "mesh.obj:1: vertex index 0 is out of range, 0 vertices so far");
  EXPECT_EQ(refusal("f a/1 2 3\n"), "mesh.obj:1: 'a' is not a vertex index");
  EXPECT_EQ(refusal("f 99999999999999999999 2 3\n"),
            "mesh.obj:1: '99999999999999999999' is not a vertex index");
}

TEST(ReadObj, GivesAnEmptyMeshForAFileWithoutFaces) {
  EXPECT_TRUE(parse("").triangles.empty());
}

TEST(ReadObj, NamesAPathThatCannotBeRead) {
  const auto missing = message_of<std::runtime_error>([] { read_obj(std::filesystem::path("no/such.obj")); });
  EXPECT_NE(missing.find("no/such.obj: cannot be read: No such file"), std::string::npos) << missing;
  const auto other = message_of<std::runtime_error>([] { read_obj(std::filesystem::path("mesh.ply")); });
  EXPECT_EQ(other, "mesh.ply: only Wavefront meshes (.obj) can be read");
  const auto folder = message_of<std::runtime_error>([] { read_obj(std::filesystem::path("/")); });
  EXPECT_NE(folder.find("folder"), std::string::npos) << folder;
}

}  // namespace
}  // namespace solidnoise
