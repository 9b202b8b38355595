#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "meshnoise/run_meshnoise.h"
#include "meshnoise/sample_torus.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise::look_test {
namespace {

// A torus with numbers, baked with some flags into a .ply.
PolygonMesh baked_with(const std::vector<std::string>& flags,
                       const PolygonMesh& mesh = torus_with_numbers()) {
  const TemporaryFolder folder;
  write_sample(folder, "in.ply", mesh);
  std::vector<std::string> arguments{"bake", "in.ply", "--out", "out.ply", "--quiet"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  const ToolResult result = run_meshnoise(arguments, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return result.status == 0 ? read_mesh(folder.file("out.ply")).mesh : PolygonMesh();
}

Vec<3> kept_direction(const PolygonMesh& mesh, std::size_t vertex) {
  return {mesh.property("direction_x")->values[vertex], mesh.property("direction_y")->values[vertex],
          mesh.property("direction_z")->values[vertex]};
}

TEST(BakeLook, KeepsTheNumbersThatItIsAskedFor) {
  const PolygonMesh baked = baked_with({"--frequency", "4..16", "--magnitude", "1..3", "--bias", "0", "--by",
                                        "heat", "--percentiles", "0", "100", "--gamma", "2", "--keep",
                                        "frequency,magnitude,weight,steering,bandwidth,bias"});
  const std::vector<double> heat = numbers_of(baked, "heat");
  for (std::size_t v = 0; v < heat.size(); ++v) {
    const double weight = heat[v] * heat[v];
    const double tolerance = 1e-5;  // some roundings to single precision, of numbers up to 16
    ASSERT_NEAR(numbers_of(baked, "steering")[v], heat[v], tolerance);
    ASSERT_NEAR(numbers_of(baked, "weight")[v], weight, tolerance);
    ASSERT_NEAR(numbers_of(baked, "frequency")[v], 4.0 * std::pow(4.0, weight), tolerance);
    ASSERT_NEAR(numbers_of(baked, "magnitude")[v], 1.0 + 2.0 * weight, tolerance);
    ASSERT_EQ(numbers_of(baked, "bandwidth")[v], 1.0);
    ASSERT_EQ(numbers_of(baked, "bias")[v], 0.0);
  }
}

TEST(BakeLook, EverySourceSteersAndRangesMayFall) {
  for (const std::string by :
       {"mean-curvature", "gaussian-curvature", "max-curvature", "abs-curvature", "height", "heat"}) {
    const PolygonMesh baked = baked_with({"--frequency", "9..3", "--by", by, "--keep", "frequency,steering"});
    const std::vector<double> frequency = numbers_of(baked, "frequency");
    const std::vector<double> steering = numbers_of(baked, "steering");
    ASSERT_FALSE(steering.empty()) << by;
    const auto [least, most] = std::minmax_element(steering.begin(), steering.end());
    EXPECT_FLOAT_EQ(static_cast<float>(frequency[static_cast<std::size_t>(least - steering.begin())]), 9.0f)
        << by;
    EXPECT_FLOAT_EQ(static_cast<float>(frequency[static_cast<std::size_t>(most - steering.begin())]), 3.0f)
        << by;
  }
}

TEST(BakeLook, DisplacesByTheNoiseAtRestPositions) {
  const std::vector<std::string> flags{"--noise", "solid", "--octaves", "1", "--bias", "0"};
  std::vector<std::string> displaced = flags;
  displaced.insert(displaced.end(), {"--displace", "0.03"});
  const PolygonMesh rest = baked_with(flags);
  const PolygonMesh moved = baked_with(displaced);
  EXPECT_EQ(numbers_of(moved, "noise"), numbers_of(rest, "noise"));
  const SurfaceMesh surface(rest);
  const std::vector<Vec<3>> normals = surface.to_vertices(surface.normals());
  const std::vector<double> noise = numbers_of(rest, "noise");
  for (std::size_t v = 0; v < noise.size(); ++v) {
    const Vec<3> expected = rest.positions[v] + 0.03 * noise[v] * normals[v];
    ASSERT_LT(glm::length(moved.positions[v] - expected), 1e-6) << "vertex " << v;  // positions are floats
  }
}

TEST(BakeLook, RefinesWithoutMovingOrChangingTheOldVertices) {
  const std::vector<std::string> flags{"--noise",   "surface", "--frequency", "3",
                                       "--octaves", "1",       "--bias",      "0"};
  const PolygonMesh coarse = baked_with(flags);
  const std::size_t count = coarse.positions.size();
  for (const std::string amount : {"1", "2", "auto"}) {
    std::vector<std::string> refining = flags;
    refining.insert(refining.end(), {"--refine", amount});
    const PolygonMesh fine = baked_with(refining);
    ASSERT_GT(fine.positions.size(), count) << amount;
    for (std::size_t v = 0; v < count; ++v) {
      ASSERT_EQ(fine.positions[v], coarse.positions[v]) << amount;
      ASSERT_EQ(numbers_of(fine, "noise")[v], numbers_of(coarse, "noise")[v]) << amount;
      ASSERT_EQ(numbers_of(fine, "label")[v], numbers_of(coarse, "label")[v]) << amount;
    }
  }
}

// OpenMesh's subdividers: those that smooth draw vertices towards the inside.
TEST(BakeLook, RefinesByTheMethodsOfOpenMesh) {
  const std::vector<std::string> flags{"--noise", "solid", "--frequency", "3", "--bias", "0"};
  const PolygonMesh coarse = baked_with(flags);
  const std::size_t count = coarse.positions.size();
  for (const std::string method : {"longest-edge", "sqrt3", "loop"}) {
    for (const std::string amount : {"1", "auto"}) {
      std::vector<std::string> refining = flags;
      refining.insert(refining.end(), {"--refine", amount, "--refine-method", method});
      const PolygonMesh fine = baked_with(refining);
      ASSERT_GT(fine.positions.size(), count) << method;
      for (std::size_t v = 0; v < count; ++v) {
        ASSERT_EQ(numbers_of(fine, "label")[v], numbers_of(coarse, "label")[v]) << method;
        if (method != "longest-edge") continue;
        ASSERT_EQ(fine.positions[v], coarse.positions[v]);
        ASSERT_EQ(numbers_of(fine, "noise")[v], numbers_of(coarse, "noise")[v]);
      }
    }
  }
}

// Root mean square distance of the vertices from the index on from the torus of radii 1 and 0.4.
double distance_from_torus(const PolygonMesh& mesh, std::size_t first) {
  double sum = 0.0;
  for (std::size_t v = first; v < mesh.positions.size(); ++v) {
    const Vec<3>& p = mesh.positions[v];
    const double distance = std::hypot(std::hypot(p.x, p.z) - 1.0, p.y) - 0.4;
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(mesh.positions.size() - first));
}

// The middle of an edge is off the surface by the second order of its length, that of the curve by less.
TEST(BakeLook, NewVerticesLieOnTheEdgesOrOnTheSmoothSurface) {
  const std::size_t count = torus_with_numbers().positions.size();
  const double on_edges = distance_from_torus(baked_with({"--refine", "1"}), count);
  const double also = distance_from_torus(baked_with({"--refine", "1", "--refine-shape", "edges"}), count);
  const double smooth = distance_from_torus(baked_with({"--refine", "1", "--refine-shape", "smooth"}), count);
  EXPECT_EQ(on_edges, also);
  EXPECT_LT(smooth, 0.3 * on_edges);
}

TEST(BakeLook, OrientsAlongEachAxisOfEitherSign) {
  for (const auto& axis : {Vec<3>(1, 0, 0), Vec<3>(0, -2, 0), Vec<3>(0, 0, 1), Vec<3>(-1, 0, 0),
                           Vec<3>(0, 1, 0), Vec<3>(0, 0, -1), Vec<3>(1, 2, -3)}) {
    const PolygonMesh baked =
        baked_with({"--noise", "oriented", "--direction", std::to_string(axis.x), std::to_string(axis.y),
                    std::to_string(axis.z), "--keep", "direction", "--smooth-radius", "0"});
    ASSERT_GT(spread(numbers_of(baked, "noise")), 1.0);
    const SurfaceMesh surface(baked);
    const std::vector<Vec<3>> normals = surface.to_vertices(surface.normals());
    for (std::size_t v = 0; v < normals.size(); ++v) {
      const Vec<3> tangent = axis - glm::dot(axis, normals[v]) * normals[v];
      if (glm::length(tangent) < 0.1 * glm::length(axis))
        continue;  // across the surface: any direction will do
      // A line has no sign. Kept in single precision.
      ASSERT_NEAR(std::abs(glm::dot(kept_direction(baked, v), glm::normalize(tangent))), 1.0, 1e-5) << v;
    }
  }
}

// Of a torus, the larger curvature is that of the tube wherever 1/0.4 exceeds cos / (1 + 0.4 cos):
// everywhere. The tessellation is irregular and coarse, so directions are within 10 degrees on average.
TEST(BakeLook, FollowsThePrincipalCurvatures) {
  for (const std::string which : {"max-curvature", "min-curvature"}) {
    const PolygonMesh baked = baked_with({"--noise", "oriented", "--follow", which, "--keep", "direction"});
    double mean = 0.0;
    for (std::size_t v = 0; v < baked.positions.size(); ++v) {
      const Vec<3>& p = baked.positions[v];
      const Vec<3> around = glm::normalize(Vec<3>(-p.z, 0.0, p.x));  // along the great circle
      const double along = std::abs(glm::dot(kept_direction(baked, v), around));
      mean += (which == "min-curvature" ? along : std::sqrt(std::max(0.0, 1.0 - along * along))) /
              static_cast<double>(baked.positions.size());
    }
    EXPECT_GT(mean, std::cos(10.0 * 3.14159265 / 180.0)) << which;
  }
}

TEST(BakeLook, BlemishesAreCountedAndBaked) {
  const TemporaryFolder folder;
  folder.write("in.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 5 5 5\nv 1 0 0\n"
               "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 3 2 1\nf 1 2 2\nf 2 7 3\n");
  const ToolResult result = run_meshnoise({"bake", "in.obj", "--out", "out.ply"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* text : {"between more than two faces", "1 edge has no length", "degenerate", "repeats"}) {
    EXPECT_NE(result.err.find(text), std::string::npos) << "lacks " << text << ": " << result.err;
  }
  const std::vector<double> noise = numbers_of(read_mesh(folder.file("out.ply")).mesh, "noise");
  ASSERT_EQ(noise.size(), 7u);
  for (const double value : noise) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace solidnoise::look_test
