// Sequences: frames of noise that changes, on a mesh that stands still or on one that is deformed.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"

namespace solidnoise::sequence_test {
namespace {

std::vector<double> noise_in(const TemporaryFolder& folder, const std::string& name) {
  const PolygonMesh mesh = read_mesh(folder.file(name)).mesh;
  const VertexProperty* const noise = mesh.property("noise");
  return noise ? noise->values : std::vector<double>{};
}

// And turned by `by` radians, which takes curvatures' directions along.
PolygonMesh bent(PolygonMesh mesh, double by) {
  for (Vec<3>& p : mesh.positions) {
    p = Vec<3>(p.x + by * p.y * p.y, p.y, p.z - by);
    p = Vec<3>(std::cos(by) * p.x - std::sin(by) * p.y, std::sin(by) * p.x + std::cos(by) * p.y, p.z);
  }
  return mesh;
}

TEST(MeshSequence, LoopsAndChanges) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  for (const std::vector<std::string>& noise : {std::vector<std::string>{"--evolve", "0.5"},
                                                {"--noise", "solid", "--dims", "4"},
                                                {"--noise", "kensler-solid", "--dims", "4"}}) {
    std::vector<std::string> arguments{"bake",   "in.ply", "--frames", "0-48x12",    "--frequency", "8",
                                       "--loop", "2",      "--out",    "out.##.ply", "--force"};
    arguments.insert(arguments.end(), noise.begin(), noise.end());
    const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto first = noise_in(folder, "out.00.ply");
    ASSERT_FALSE(first.empty());
    EXPECT_NE(noise_in(folder, "out.12.ply"), first);
    EXPECT_NE(noise_in(folder, "out.24.ply"), first);
    EXPECT_EQ(noise_in(folder, "out.48.ply"), first);
  }
}

TEST(MeshSequence, ADeformedMeshKeepsTheValuesOfItsRest) {
  const TemporaryFolder folder;
  const PolygonMesh rest = sample_torus();
  write_sample(folder, "rest.ply", rest);
  write_sample(folder, "walk.1.ply", bent(rest, 0.5));
  write_sample(folder, "walk.2.ply", bent(rest, 1.0));
  const auto bake = [&](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
    ASSERT_EQ(result.status, 0) << result.err;
  };
  for (const std::vector<std::string>& look :
       {std::vector<std::string>{"--force"}, {"--preset", "scales", "--force"}}) {
    bake({"walk.#.ply", "--frames", "1-2", "--rest", "rest.ply", "--out", "out.#.ply"}, look);
    bake({"rest.ply", "--out", "own.ply"}, look);
    for (const std::string number : {"1", "2"}) {
      EXPECT_EQ(noise_in(folder, "out." + number + ".ply"), noise_in(folder, "own.ply"));
      EXPECT_EQ(read_mesh(folder.file("out." + number + ".ply")).mesh.positions,
                read_mesh(folder.file("walk." + number + ".ply")).mesh.positions);
    }
  }
}

TEST(MeshSequence, DescribesItsFirstFrameAsItIsBaked) {
  const TemporaryFolder folder;
  write_sample(folder, "rest.ply", sample_torus());
  write_sample(folder, "walk.1.ply", bent(sample_torus(), 0.5));
  const auto described = [&](const std::vector<std::string>& arguments) {
    const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  EXPECT_EQ(described({"bake", "walk.#.ply", "--frames", "1-2", "--rest", "rest.ply", "--describe"}),
            described({"bake", "rest.ply", "--describe"}));
}

TEST(MeshSequence, RefusesWhatIsNoSequence) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  write_sample(folder, "other.ply", sample_torus(9));
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"bake", "in.ply"});
    const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
    EXPECT_NE(result.status, 0);
    return result.err;
  };
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& part) {
    const std::string message = refusal(arguments);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect({"--frames", "1-2", "--out", "out.#.ply"}, "--frames has no effect");
  expect({"--frames", "1-2", "--evolve", "1", "--out", "out.ply"}, "--out");
  expect({"--frames", "1-2", "--evolve", "1", "--loop", "0.3", "--out", "out.#.ply"}, "--loop is 0.3");
  expect({"--noise", "solid", "--dims", "4", "--frequency", "1", "--loop", "1", "--out", "out.ply"},
         "--loop is 1; it must");
  expect({"--fps", "25", "--out", "out.ply"}, "--fps");
  expect({"--out", "out.#.ply"}, "give --frames");
  expect({"--rest", "other.ply", "--out", "out.ply"}, "--rest has");
  expect({"--dims", "4", "--out", "out.ply"}, "--dims is 4");
  expect({"--time", "1", "--out", "out.ply"}, "--time is 1");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"in.ply", "other.ply"}));
}

TEST(MeshSequence, SaysThatALoopIsItsOwnNegative) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", sample_torus());
  const auto said = [&](const char* rate) {
    const ToolResult result = run_meshnoise({"bake", "in.ply", "--noise", "solid", "--frequency", "3",
                                             "--evolve", rate, "--loop", "2", "--force", "--out", "out.ply"},
                                            {.folder = folder.path()});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  EXPECT_NE(said("0.4").find("much like its own negative"), std::string::npos);
  EXPECT_EQ(said("1").find("negative"), std::string::npos);
}

}  // namespace
}  // namespace solidnoise::sequence_test
