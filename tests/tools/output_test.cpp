#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise::output_test {
namespace {

std::string run_well(std::vector<std::string> arguments) {
  const ToolResult result = run_vdbnoise(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.err;
}

std::string make(const TemporaryFolder& folder, const std::string& name, std::vector<std::string> arguments) {
  const std::string file = folder.file(name);
  for (const std::string& argument : {std::string("--dim"), std::string("24"), std::string("--out"), file}) {
    arguments.push_back(argument);
  }
  run_well(arguments);
  return file;
}

openvdb::Vec3SGrid::Ptr read_vectors(const std::string& file) {
  const auto grid = openvdb::gridPtrCast<openvdb::Vec3SGrid>(read_grid(file));
  EXPECT_TRUE(grid) << file;
  return grid;
}

template <typename Grid>
bool same_values(const Grid& a, const Grid& b) {
  if (!a.tree().hasSameTopology(b.tree())) return false;
  for (auto value = a.cbeginValueOn(); value; ++value) {
    if (*value != b.tree().getValue(value.getCoord())) return false;
  }
  return true;
}

struct Expected {
  std::vector<std::string> flags;
  std::vector<std::string> names;
  std::string value_type;
  std::string vector_type;
};

// What readers look for, the recipe that makes the file again, and what info says.
TEST(VdbnoiseOutput, GridsHaveTheirNamesAndTypesAndAreMadeAgainFromTheirRecipe) {
  const std::vector<Expected> all{
      {{"--output", "gradient"}, {"gradient"}, "vec3s", "covariant"},
      {{"--output", "value,gradient", "--octaves", "2"}, {"density", "gradient"}, "", ""},
      {{"--output", "curl"}, {"vel"}, "vec3s", "contravariant relative"},
      {{"--output", "curl", "--noise", "kensler", "--dims", "4", "--time", "0.3", "--grid", "wind"},
       {"wind"},
       "vec3s",
       "contravariant relative"},
      {{"--output", "color", "--range", "unit"}, {"color"}, "vec3s", "invariant"},
      {{"--output", "phase,intensity", "--noise", "gabor-oriented", "--evolve", "1", "--time", "0.2"},
       {"phase", "intensity"},
       "float",
       ""},
  };
  for (const Expected& expected : all) {
    SCOPED_TRACE(testing::PrintToString(expected.flags));
    const TemporaryFolder folder;
    const std::string file = make(folder, "a.vdb", expected.flags);
    const VdbSummary summary = read_vdb_summary(file);
    ASSERT_EQ(summary.grids.size(), expected.names.size());
    const ToolResult info = run_vdbnoise({"info", file});
    run_well({"--recipe", file, "--quiet", "--out", folder.file("b.vdb")});
    for (std::size_t i = 0; i < summary.grids.size(); ++i) {
      const GridSummary& grid = summary.grids[i];
      EXPECT_EQ(grid.name, expected.names[i]);
      EXPECT_EQ(grid.grid_class, "unknown");
      EXPECT_EQ(grid.active_voxels, 24u * 24u * 24u);
      EXPECT_NE(info.out.find("grid " + grid.name), std::string::npos) << info.out;
      if (!expected.value_type.empty()) {
        EXPECT_EQ(grid.value_type, expected.value_type);
        EXPECT_EQ(grid.vector_type, expected.vector_type);
      }
      if (grid.value_type == "vec3s") {
        EXPECT_NE(info.out.find("vec3s, " + grid.vector_type + ", unknown"), std::string::npos) << info.out;
        EXPECT_TRUE(same_values(
            *openvdb::gridPtrCast<openvdb::Vec3SGrid>(read_grid(file, grid.name)),
            *openvdb::gridPtrCast<openvdb::Vec3SGrid>(read_grid(folder.file("b.vdb"), grid.name))));
      } else {
        EXPECT_TRUE(same_values(*read_float_grid(file, grid.name),
                                *read_float_grid(folder.file("b.vdb"), grid.name)));
      }
    }
  }
}

// The noise, its values and derivatives, in the same places as without --output.
TEST(VdbnoiseOutput, GradientIsThatOfTheValues) {
  const TemporaryFolder folder;
  // Differences between voxels have the error of interpolation over the voxel's size; there is to be none.
  const std::vector<std::string> noise{"--frequency", "1", "--voxel", "0.03125", "--exact"};
  const auto with = [&](const std::string& name, std::vector<std::string> flags) {
    flags.insert(flags.end(), noise.begin(), noise.end());
    flags.insert(flags.end(), {"--box", "0", "0", "0", "0.75", "0.75", "0.75", "--out", folder.file(name)});
    run_well(flags);
    return folder.file(name);
  };
  const std::string both = with("both.vdb", {"--output", "value,gradient"});
  const auto plain = read_float_grid(both, "density");
  // Kernels are within the error for the gradient, too: the values differ by less than that from those alone.
  const auto alone = read_float_grid(with("value.vdb", {"--raw"}));
  double square = 0.0;
  for (auto value = plain->cbeginValueOn(); value; ++value) {
    square += std::pow(*value - alone->tree().getValue(value.getCoord()), 2);
  }
  EXPECT_LT(std::sqrt(square / static_cast<double>(plain->activeVoxelCount())), 0.02);
  const auto gradient = openvdb::gridPtrCast<openvdb::Vec3SGrid>(read_grid(both, "gradient"));
  EXPECT_TRUE(same_values(*gradient, *read_vectors(with("alone.vdb", {"--output", "gradient"}))));
  double largest = 0.0;
  for (auto value = gradient->cbeginValueOn(); value; ++value) {
    for (int axis = 0; axis < 3; ++axis) {
      openvdb::Coord step(0);
      step[axis] = 1;
      const openvdb::Coord next = value.getCoord() + step;
      const openvdb::Coord last = value.getCoord() - step;
      if (!plain->tree().isValueOn(next) || !plain->tree().isValueOn(last)) continue;
      const double slope = (plain->tree().getValue(next) - plain->tree().getValue(last)) / (2.0 * 0.03125);
      largest = std::max(largest, std::abs(slope - (*value)[axis]));
    }
  }
  // h^2 / 6 of the third derivative, (2 pi)^3 times about 2 at the band's upper end and 4 sigma.
  EXPECT_LT(largest, 0.03125 * 0.03125 / 6.0 * std::pow(6.3, 3) * 2.0 * 4.0);
  EXPECT_GT(largest, 0.0);
}

TEST(VdbnoiseOutput, VelocityHasTheSpeedThatIsAskedFor) {
  const TemporaryFolder folder;
  const std::string file = folder.file("vel.vdb");
  const std::string says = run_well(
      {"--output", "curl", "--frequency", "4", "--speed", "3", "--dim", "48", "--half", "--out", file});
  double square = 0.0;
  for (const Moments& component : measure(*read_vectors(file))) {
    square += component.mean() * component.mean() + component.sigma() * component.sigma();
  }
  // 8 waves along each axis, some thousand independent places: 4 times 1.3 / sqrt(1000) of the square.
  EXPECT_NEAR(std::sqrt(square), 3.0, 0.5 * 0.16 * 3.0);
  EXPECT_NE(says.find("root mean square length"), std::string::npos) << says;
  EXPECT_TRUE(read_vdb_summary(file).grids[0].saved_as_half);
  EXPECT_EQ(says.find("warning"), std::string::npos) << says;
}

TEST(VdbnoiseOutput, ColorsDifferFromEachOtherAndFromTheNoise) {
  const TemporaryFolder folder;
  const std::string colors =
      make(folder, "color.vdb", {"--output", "color", "--period", "2", "2", "2", "--frequency", "4"});
  const std::string noise =
      make(folder, "noise.vdb", {"--raw", "--period", "2", "2", "2", "--frequency", "4"});
  const auto grid = read_vectors(colors);
  const auto value = read_float_grid(noise);
  double products[4] = {};
  for (auto color = grid->cbeginValueOn(); color; ++color) {
    products[0] += (*color)[0] * (*color)[1];
    products[1] += (*color)[1] * (*color)[2];
    products[2] += (*color)[2] * (*color)[0];
    products[3] += (*color)[0] * value->tree().getValue(color.getCoord());
  }
  // Some thousand independent places: 4 / sqrt(1000).
  for (const double product : products) EXPECT_NEAR(product / grid->activeVoxelCount(), 0.0, 0.13);
}

// A level set of another program's: OpenVDB's own sphere.
std::string write_sphere(const TemporaryFolder& folder) {
  const auto sphere =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(0.5f, openvdb::Vec3f(0.0f), 0.04f);
  sphere->setName("surface");
  write_vdb(folder.file("sphere.vdb"), {sphere}, {.existing = Existing::replace});
  return folder.file("sphere.vdb");
}

TEST(VdbnoiseOutput, NothingFlowsThroughTheBoundary) {
  const TemporaryFolder folder;
  const std::string sphere = write_sphere(folder);
  const auto velocity_at_surface = [&](const std::vector<std::string>& more) {
    std::vector<std::string> flags{"--output", "curl",  "--frequency",         "2", "--voxel", "0.02",
                                   "--force",  "--out", folder.file("vel.vdb")};
    flags.insert(flags.end(), more.begin(), more.end());
    run_well(flags);
    const auto grid = read_vectors(folder.file("vel.vdb"));
    double normal = 0.0;
    double all = 0.0;
    for (auto value = grid->cbeginValueOn(); value; ++value) {
      openvdb::Vec3d p = grid->indexToWorld(value.getCoord());
      if (std::abs(p.length() - 0.5) > 0.004) continue;
      p.normalize();
      const openvdb::Vec3d v(*value);
      normal += std::pow(v.dot(p), 2);
      all += v.dot(v);
    }
    return std::sqrt(normal / all);
  };
  // A third of the power without a boundary. With one, where it is off by up to 0.004 and h^2 / R = 0.003,
  // the normal component has risen to about 0.005 / 0.4 of the speed; ramps are steepest at the surface.
  EXPECT_GT(velocity_at_surface({}), 0.4);
  EXPECT_LT(velocity_at_surface({"--boundary", sphere, "--boundary-width", "0.4"}), 0.04);

  // The digest of the surface's file is in the recipe, and another surface is refused.
  run_well({"--recipe", folder.file("vel.vdb"), "--quiet", "--out", folder.file("again.vdb")});
  EXPECT_TRUE(same_values(*read_vectors(folder.file("vel.vdb")), *read_vectors(folder.file("again.vdb"))));
  run_well({"--raw", "--dim", "8", "--quiet", "--force", "--out", sphere});
  const ToolResult refused =
      run_vdbnoise({"--recipe", folder.file("vel.vdb"), "--quiet", "--out", folder.file("c.vdb")});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("--boundary"), std::string::npos) << refused.err;
}

TEST(VdbnoiseOutput, BoundariesMustBeLevelSets) {
  const TemporaryFolder folder;
  run_well({"--raw", "--dim", "8", "--quiet", "--out", folder.file("fog.vdb")});
  const ToolResult fog = run_vdbnoise({"--output", "curl", "--boundary", folder.file("fog.vdb"), "--dim", "8",
                                       "--quiet", "--out", folder.file("x.vdb")});
  EXPECT_EQ(fog.status, 1);
  EXPECT_NE(fog.err.find("fog.vdb: the grid 'density' is of class unknown; it must be a level set"),
            std::string::npos)
      << fog.err;
  const ToolResult wide =
      run_vdbnoise({"--output", "curl", "--boundary", write_sphere(folder), "--boundary-width", "10", "--dim",
                    "8", "--quiet", "--out", folder.file("x.vdb")});
  EXPECT_EQ(wide.status, 2);
  EXPECT_NE(wide.err.find("--boundary-width is 10; it must be at most 2.56"), std::string::npos) << wide.err;
  EXPECT_EQ(folder.names(), (std::set<std::string>{"fog.vdb", "sphere.vdb"}));
}

TEST(VdbnoiseOutput, FilesAreWhatOpenVdbsOwnToolsRead) {
  const std::string tool = "/usr/bin/vdb_print";
  if (!std::filesystem::exists(tool)) GTEST_SKIP() << "needs vdb_print";
  const TemporaryFolder folder;
  const std::string file = make(folder, "vel.vdb", {"--output", "curl", "--half"});
  const ToolResult printed = RunningTool(tool, {"-l", file}, {}).wait();
  EXPECT_EQ(printed.status, 0) << printed.err;
  for (const char* text : {"Name: vel", "Tree_vec3s_5_4_3", "13,824", "vector_type: contravariant relative",
                           "is_saved_as_half_float: true", "is_local_space: false"}) {
    EXPECT_NE(printed.out.find(text), std::string::npos) << text << '\n' << printed.out;
  }
}

TEST(VdbnoiseOutput, PartsJoinToTheWhole) {
  for (const std::string output : {"value,gradient", "curl"}) {
    const TemporaryFolder folder;
    const std::string whole = make(folder, "whole.vdb", {"--output", output, "--half"});
    const std::string one = make(folder, "one.vdb", {"--output", output, "--half", "--shard", "1/2"});
    const std::string two = make(folder, "two.vdb", {"--output", output, "--half", "--shard", "2/2"});
    run_well({"merge", one, two, "--out", folder.file("merged.vdb")});
    const VdbSummary a = read_vdb_summary(whole);
    const VdbSummary b = read_vdb_summary(folder.file("merged.vdb"));
    ASSERT_EQ(a.grids.size(), b.grids.size());
    for (std::size_t i = 0; i < a.grids.size(); ++i) {
      EXPECT_EQ(a.grids[i].name, b.grids[i].name);
      EXPECT_EQ(a.grids[i].vector_type, b.grids[i].vector_type);
      EXPECT_EQ(a.grids[i].metadata.at("solidnoise:sigma"), b.grids[i].metadata.at("solidnoise:sigma"));
    }
    const std::string name = a.grids.back().name;
    EXPECT_TRUE(
        same_values(*openvdb::gridPtrCast<openvdb::Vec3SGrid>(read_grid(whole, name)),
                    *openvdb::gridPtrCast<openvdb::Vec3SGrid>(read_grid(folder.file("merged.vdb"), name))));
  }
}

TEST(VdbnoiseOutput, BandLimitTakesFromTheSpeedWhatItFilters) {
  const TemporaryFolder folder;
  const auto speed_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> flags{"--output", "curl", "--frequency", "4", "--voxel", "0.0625"};
    flags.insert(flags.end(), more.begin(), more.end());
    flags.insert(flags.end(), {"--quiet", "--force", "--out", folder.file("vel.vdb")});
    run_well(flags);
    double square = 0.0;
    for (const Moments& m : measure(*read_vectors(folder.file("vel.vdb")))) {
      square += m.mean() * m.mean() + m.sigma() * m.sigma();
    }
    return std::sqrt(square);
  };
  // Waves of 4 voxels keep 73 % of their amplitude, those of the band's upper half less.
  const double plain = speed_with({});
  const double limited = speed_with({"--band-limit"});
  EXPECT_NEAR(plain, 1.0, 0.1);
  EXPECT_LT(limited, 0.8 * plain);
  EXPECT_GT(limited, 0.4 * plain);
}

TEST(VdbnoiseOutput, PreviewsArePicturesOfASlice) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> all{
      {"--output", "curl"},
      {"--output", "gradient", "--up", "z"},
      {"--output", "color", "--range", "signed"},
      {"--output", "value,gradient"},
      {"--output", "intensity,phase", "--noise", "gabor-oriented"}};
  for (const auto& output : all) {
    std::vector<std::string> flags = output;
    flags.insert(flags.end(), {"--dim", "16", "--quiet", "--force", "--preview", folder.file("a.png")});
    run_well(flags);
    EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
  }
  EXPECT_EQ(folder.names(), std::set<std::string>{"a.png"});
}

TEST(VdbnoiseOutput, DescriptionNamesTheGrids) {
  const ToolResult result = run_vdbnoise({"--describe", "--output", "value,gradient", "--dim", "8"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto grids = nlohmann::json::parse(result.out).at("grids");
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids.at(0).at("name"), "density");
  EXPECT_EQ(grids.at(1).at("name"), "gradient");
  EXPECT_EQ(grids.at(1).at("components"), 3);
}

TEST(VdbnoiseOutput, AnalyzeRefusesVectors) {
  const TemporaryFolder folder;
  const std::string file = make(folder, "vel.vdb", {"--output", "curl"});
  const ToolResult result = run_vdbnoise({"analyze", file});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("has no grid of floats; it has 'vel' (vec3s)"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace solidnoise::output_test
