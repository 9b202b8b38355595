// Meshes of productions come back with all that they had.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "solidnoise/geometry/read_points.h"

namespace solidnoise::round_trip_test {
namespace {

ToolResult run_in(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  return run_meshnoise(arguments, {.folder = folder.path()});
}

TEST(RoundTrip, AnObjKeepsItsLinesAndAPlyItsElements) {
  const TemporaryFolder folder;
  const std::string tail = "vt 0 0\nvt 1 1\ng arm\nusemtl skin\nf 1/1 2/2 3/2\nf 1/1 3/2 4/1\n";
  folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + tail);
  const ToolResult obj = run_in(folder, {"bake", "in.obj", "--out", "out.obj"});
  ASSERT_EQ(obj.status, 0) << obj.err;
  EXPECT_EQ(obj.err.find("dropped"), std::string::npos) << obj.err;
  EXPECT_TRUE(folder.read("out.obj").ends_with(tail));
  EXPECT_EQ(read_mesh(folder.file("out.obj")).mesh.properties.size(), 3u);  // colours
  // And makes the same again from the recipe that it carries.
  ASSERT_EQ(run_in(folder, {"bake", "in.obj", "--recipe", "out.obj", "--out", "again.obj"}).status, 0);
  EXPECT_EQ(folder.read("again.obj"), folder.read("out.obj"));
  // Where faces change, it is said.
  const ToolResult refined = run_in(folder, {"bake", "in.obj", "--refine", "1", "--out", "refined.obj"});
  EXPECT_NE(refined.err.find("texture coordinates are dropped"), std::string::npos) << refined.err;

  folder.write(
      "in.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nproperty int part\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 42\n");
  const ToolResult ply = run_in(folder, {"bake", "in.ply", "--out", "out.ply"});
  ASSERT_EQ(ply.status, 0) << ply.err;
  EXPECT_TRUE(folder.read("out.ply").ends_with("\n3 0 1 2 42\n"));
}

TEST(RoundTrip, APlyOfTextStaysOne) {
  const TemporaryFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float mass\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  folder.write("in.ply", header + "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n");
  ASSERT_EQ(run_in(folder, {"bake", "in.ply", "--noise", "solid", "--out", "out.ply"}).status, 0);
  EXPECT_TRUE(folder.read("out.ply").starts_with("ply\nformat ascii 1.0\n"));
  // What another format has no place for is said.
  const ToolResult result = run_in(folder, {"bake", "in.ply", "--noise", "solid", "--out", "out.obj"});
  EXPECT_NE(result.err.find("the vertices' mass are dropped"), std::string::npos) << result.err;
}

TEST(RoundTrip, SaysWhatItCannotKeep) {
  const TemporaryFolder folder;
  folder.write(
      "in.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  const ToolResult ply = run_in(folder, {"bake", "in.ply", "--noise", "solid", "--out", "a.obj"});
  EXPECT_NE(ply.err.find("the vertices' s, t are dropped"), std::string::npos) << ply.err;
  folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  const std::vector<std::string> bake{"bake", "in.obj", "--noise", "solid", "--out", "b.obj"};
  EXPECT_EQ(run_in(folder, bake).err.find("normals"), std::string::npos);
  std::vector<std::string> displace = bake;
  displace.insert(displace.end(), {"--displace", "0.1", "--force"});
  const ToolResult obj = run_in(folder, displace);
  EXPECT_NE(obj.err.find("normals of its faces' corners stay"), std::string::npos) << obj.err;
}

TEST(RoundTrip, NumbersThatAreNoneAreRefused) {
  const TemporaryFolder folder;
  const auto refusal = [&](const char* x, const char* heat) {
    folder.write("in.ply",
                 fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty float y\n"
                             "property float z\nproperty float heat\nelement face 1\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0 1\n{} 0 0 {}\n0 1 0 3\n3 0 1 2\n",
                             x, heat));
    const ToolResult result =
        run_in(folder, {"bake", "in.ply", "--bias", "0..1", "--by", "heat", "--out", "out.ply"});
    EXPECT_NE(result.status, 0);
    EXPECT_EQ(folder.names().count("out.ply"), 0u);
    return result.err;
  };
  EXPECT_NE(refusal("1", "nan").find("is nan at vertex 1"), std::string::npos) << refusal("1", "nan");
  EXPECT_NE(refusal("1e300", "2").find("in.ply: vertex 1 has a coordinate of 1e+300"), std::string::npos);
}

TEST(RoundTrip, PointsAreBakedAsPoints) {
  const TemporaryFolder folder;
  PolygonMesh points = sample_torus();
  points.face_starts = {0};
  points.corners.clear();
  write_sample(folder, "in.ply", points);
  const ToolResult result =
      run_in(folder, {"bake", "in.ply", "--noise", "solid", "--frequency", "3", "--out", "out.ply"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err.find("  0\n"), std::string::npos) << "a histogram of nothing: " << result.err;
  write_sample(folder, "mesh.ply", sample_torus());
  ASSERT_EQ(run_in(folder, {"bake", "mesh.ply", "--noise", "solid", "--frequency", "3", "--bias", "0",
                            "--out", "b.ply"})
                .status,
            0);
  const PolygonMesh baked = read_mesh(folder.file("out.ply"), Faces::optional).mesh;
  EXPECT_EQ(baked.positions, points.positions);
  EXPECT_EQ(numbers_of(baked, "noise").size(), points.positions.size());
  EXPECT_EQ(run_in(folder, {"curvature", "in.ply", "--out", "c.ply"}).status, 1);
}

TEST(RoundTrip, NumbersOfTheVerticesSayWhereTheyRest) {
  const TemporaryFolder folder;
  PolygonMesh rest = sample_torus();
  write_sample(folder, "rest.ply", rest);
  PolygonMesh moved = rest;
  for (const int axis : {0, 1, 2}) {
    VertexProperty numbers{std::string("rest_") + "xyz" [axis], ScalarType::float64, {}};
    for (const Vec<3>& p : rest.positions) numbers.values.push_back(p[axis]);
    moved.set_property(numbers);
  }
  for (Vec<3>& p : moved.positions) p = Vec<3>(p.x + p.y * p.y, p.y, 2.0 * p.z);
  write_sample(folder, "moved.ply", moved);
  ASSERT_EQ(run_in(folder, {"bake", "moved.ply", "--rest-property", "rest", "--out", "a.ply"}).status, 0);
  ASSERT_EQ(run_in(folder, {"bake", "moved.ply", "--rest", "rest.ply", "--out", "b.ply"}).status, 0);
  EXPECT_EQ(numbers_of(read_mesh(folder.file("a.ply")).mesh, "noise"),
            numbers_of(read_mesh(folder.file("b.ply")).mesh, "noise"));
  const ToolResult none = run_in(folder, {"bake", "moved.ply", "--rest-property", "pose", "--out", "c.ply"});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("no number pose_x or posex"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace solidnoise::round_trip_test
