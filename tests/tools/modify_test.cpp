#include <cstdlib>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "tools/run_vdbnoise.h"
#include "tools/same_grid.h"

namespace solidnoise::modify_test {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

// A file as a simulation leaves it: a density with tiles, stored as half, a temperature, a velocity, a level
// set, and metadata of all of them.
void write_simulation(const std::string& path) {
  const auto density = FloatGrid::create(0.0f);
  density->setName("density");
  density->setGridClass(openvdb::GRID_FOG_VOLUME);
  density->setTransform(openvdb::math::Transform::createLinearTransform(0.05));
  density->fill({Coord(-16), Coord(15)}, 0.5f);
  density->fill({Coord(-4), Coord(3)}, 1.0f);
  density->setSaveFloatAsHalf(true);
  density->insertMeta("artist", openvdb::StringMetadata("someone"));
  const auto heat = FloatGrid::create(0.0f);
  heat->setName("temperature");
  heat->setTransform(openvdb::math::Transform::createLinearTransform(0.05));
  heat->fill({Coord(0), Coord(9)}, -2.0f);
  const auto velocity = openvdb::Vec3SGrid::create();
  velocity->setName("vel");
  velocity->fill({Coord(0), Coord(4)}, openvdb::Vec3s(1, 2, 3));
  const auto surface = openvdb::tools::createLevelSetSphere<FloatGrid>(0.6f, openvdb::Vec3f(0), 0.05f);
  surface->setName("surface");
  openvdb::MetaMap metadata;
  metadata.insertMeta("shot", openvdb::StringMetadata("a10"));
  write_vdb(path, {velocity, density, heat, surface},
            {.creator = "a simulation", .metadata = metadata, .frame = 7});
}

class Modify : public testing::Test {
 protected:
  Modify() : input_(folder_.file("in.vdb")) { write_simulation(input_); }

  std::string out(const std::string& name) const { return folder_.file(name); }

  void run_well(std::vector<std::string> arguments, const std::string& name) const {
    arguments.insert(arguments.end(), {"--out", out(name), "--quiet"});
    const ToolResult result = run_vdbnoise(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }

  TemporaryFolder folder_;
  std::string input_;
};

TEST_F(Modify, KeepsEverythingElseOfTheFile) {
  run_well({"--on", input_ + ":density", "--frequency", "2"}, "out.vdb");
  const VdbFile before = read_grids(input_);
  const VdbFile after = read_grids(out("out.vdb"));
  ASSERT_EQ(after.grids.size(), 4u);
  EXPECT_EQ(after.metadata.metaValue<std::string>("shot"), "a10");
  EXPECT_EQ(after.metadata.metaValue<std::string>("creator"), "a simulation");
  EXPECT_EQ(after.metadata.metaValue<std::int32_t>("frame"), 7);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(after.grids[i]->getName(), before.grids[i]->getName());
    EXPECT_EQ(after.grids[i]->type(), before.grids[i]->type());
    EXPECT_EQ(after.grids[i]->transform(), before.grids[i]->transform());
    EXPECT_EQ(after.grids[i]->getGridClass(), before.grids[i]->getGridClass());
    EXPECT_EQ(after.grids[i]->activeVoxelCount(), before.grids[i]->activeVoxelCount());
  }
  EXPECT_TRUE(after.grids[1]->saveFloatAsHalf());
  EXPECT_EQ(after.grids[1]->metaValue<std::string>("artist"), "someone");
  EXPECT_NE((*after.grids[1])["solidnoise:recipe"], nullptr);
  EXPECT_EQ((*after.grids[2])["solidnoise:recipe"], nullptr);
  EXPECT_TRUE(
      same_values(*read_float_grid(input_, "temperature"), *read_float_grid(out("out.vdb"), "temperature")));
  EXPECT_FALSE(same_values(*read_float_grid(input_, "density"), *read_float_grid(out("out.vdb"), "density")));
}

TEST_F(Modify, AddsTheVeryNoiseThatRawGivesOnTheSameVoxels) {
  const std::vector<std::string> noise{"--frequency", "2", "--seed", "5"};
  const auto with_noise = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), noise.begin(), noise.end());
    return arguments;
  };
  run_well(with_noise({"--raw", "--shape", input_ + ":temperature"}), "raw.vdb");
  run_well(with_noise({"--on", input_ + ":temperature", "--combine", "add", "--amount", "0.25"}), "add.vdb");
  run_well(with_noise({"--on", input_ + ":temperature", "--combine", "replace"}), "replace.vdb");
  const auto raw = read_float_grid(out("raw.vdb"));
  const auto added = read_float_grid(out("add.vdb"), "temperature");
  const auto replaced = read_float_grid(out("replace.vdb"), "temperature");
  for (auto value = raw->cbeginValueOn(); value; ++value) {
    ASSERT_EQ(added->tree().getValue(value.getCoord()), -2.0f + 0.25f * *value);
    ASSERT_EQ(replaced->tree().getValue(value.getCoord()), *value);
  }
}

TEST_F(Modify, ItsRecipeMakesTheSameAgain) {
  run_well({"--on", input_ + ":density", "--combine", "erode", "--amount", "0.7", "--mask",
            input_ + ":surface", "--frequency", "2", "--write-recipe", out("a.json")},
           "a.vdb");
  run_well({"--recipe", out("a.json"), "--threads", "1"}, "b.vdb");
  EXPECT_TRUE(
      same_values(*read_float_grid(out("a.vdb"), "density"), *read_float_grid(out("b.vdb"), "density")));
  run_well({"--recipe", out("a.vdb")}, "c.vdb");
  EXPECT_TRUE(
      same_values(*read_float_grid(out("a.vdb"), "density"), *read_float_grid(out("c.vdb"), "density")));
}

TEST_F(Modify, MaskKeepsWhatIsOutsideOfIt) {
  run_well({"--on", input_ + ":density", "--combine", "multiply", "--mask", input_ + ":surface",
            "--frequency", "2"},
           "out.vdb");
  const auto before = read_float_grid(input_, "density");
  const auto after = read_float_grid(out("out.vdb"), "density");
  int inside = 0;
  for (auto value = before->cbeginValueOn(); value; ++value) {
    if (value.isTileValue()) continue;
    const double distance = before->indexToWorld(value.getCoord()).length() - 0.6;
    const float now = after->tree().getValue(value.getCoord());
    if (distance > 0.05) {
      ASSERT_EQ(now, *value) << value.getCoord();
    }
    inside += distance < 0.0 && now != *value;
  }
  EXPECT_GT(inside, 1000);
}

TEST_F(Modify, DisplacesALevelSetThatStaysOne) {
  run_well({"--on", input_ + ":surface", "--displace", "0.05", "--frequency", "0.8", "--octaves", "2"},
           "out.vdb");
  const auto moved = read_float_grid(out("out.vdb"), "surface");
  EXPECT_EQ(openvdb::tools::CheckLevelSet<FloatGrid>(*moved).check(9), "");
  EXPECT_FALSE(same_values(*moved, *read_float_grid(input_, "surface")));
}

TEST_F(Modify, RestPositionsMoveTheNoise) {
  // Positions that are those of the voxels, moved by 0.3 along x: what --offset does the other way.
  const auto density = read_float_grid(input_, "density");
  const auto rest = openvdb::Vec3DGrid::create();
  rest->setName("rest");
  rest->setTransform(density->transform().copy());
  for (auto voxel = density->evalActiveVoxelBoundingBox().begin(); voxel; ++voxel) {
    rest->tree().setValueOn(*voxel, density->indexToWorld(*voxel) + openvdb::Vec3d(0.3, 0, 0));
  }
  write_vdb(out("rest.vdb"), {rest}, {});
  // Points are always summed, voxels only where the noise is to be exact.
  const std::vector<std::string> common{"--on",   input_ + ":density", "--frequency", "1", "--combine", "add",
                                        "--exact"};
  std::vector<std::string> by_rest = common;
  by_rest.insert(by_rest.end(), {"--rest", out("rest.vdb")});
  run_well(by_rest, "a.vdb");
  std::vector<std::string> by_offset = common;
  by_offset.insert(by_offset.end(), {"--offset", "-0.3", "0", "0"});
  run_well(by_offset, "b.vdb");
  const auto a = read_float_grid(out("a.vdb"), "density");
  const auto b = read_float_grid(out("b.vdb"), "density");
  // Rest positions are floats: 1e-7 of a world unit moves the noise by 1e-6, and both files hold half floats.
  for (auto value = a->cbeginValueOn(); value; ++value) {
    ASSERT_NEAR(*value, b->tree().getValue(value.getCoord()), 4e-3) << value.getCoord();
  }
}

TEST_F(Modify, ReplacesItsInputWhenAskedTo) {
  const ToolResult refused = run_vdbnoise({"--on", input_, "--out", input_});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("in.vdb exists; --force replaces it"), std::string::npos) << refused.err;
  const ToolResult done =
      run_vdbnoise({"--on", input_, "--frequency", "2", "--out", input_, "--force", "--quiet"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(read_grids(input_).grids.size(), 4u);
}

TEST_F(Modify, RefusesInOneLineWhatCannotBeDone) {
  const auto nan = FloatGrid::create(0.0f);
  nan->setName("bad");
  nan->tree().setValueOn(Coord(1, 2, 3), std::numeric_limits<float>::quiet_NaN());
  const auto far = FloatGrid::create(0.0f);
  far->setName("far");
  far->tree().setValueOn(Coord(1000), 1.0f);
  const auto rotated = FloatGrid::create(0.0f);
  rotated->setName("rotated");
  rotated->tree().setValueOn(Coord(1), 1.0f);
  rotated->transform().postRotate(0.5, openvdb::math::X_AXIS);
  const auto empty = FloatGrid::create(0.0f);
  empty->setName("empty");
  const auto hole = openvdb::Vec3SGrid::create();
  hole->setName("hole");
  hole->setTransform(openvdb::math::Transform::createLinearTransform(0.05));
  hole->tree().setValueOn(Coord(0), openvdb::Vec3s(0));
  write_vdb(out("odd.vdb"), {nan, far, rotated, empty, hole}, {});
  const std::set<std::string> before = folder_.names();
  struct Refusal {
    int status;
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::string odd = out("odd.vdb");
  const std::vector<Refusal> refusals{
      {1, {"--on", out("none.vdb")}, "none.vdb: cannot be read"},
      {1,
       {"--on", input_ + ":fuel"},
       "has no grid of floats 'fuel'; it has 'vel' (vec3s), 'density' (float)"},
      {1, {"--on", input_ + ":vel"}, "has no grid of floats 'vel'; it has"},
      {1, {"--on", input_ + ":surface"}, "is a level set, whose distances --combine would spoil"},
      {1, {"--on", input_, "--displace", "0.1"}, "grid 'density' is of class fog volume; --displace"},
      {1, {"--on", odd + ":bad"}, "1 values that are not finite, the first at voxel (1, 2, 3)"},
      {1, {"--on", odd + ":empty"}, "grid 'empty' has no active voxels"},
      {1,
       {"--on", input_, "--mask", input_ + ":vel"},
       "is of type vec3s; a mask must be of float, bool or mask"},
      {1, {"--on", input_, "--mask", odd + ":far"}, "lies elsewhere than grid 'density'"},
      {1, {"--on", input_, "--rest", input_ + ":density"}, "is of type float; rest positions must be"},
      {1, {"--on", input_, "--rest", odd + ":hole"}, "has no rest position at"},
      {1, {"--on", input_, "--max-memory", "1K"}, "--max-memory allows"},
      {2, {"--on", odd + ":rotated", "--preset", "smoke"}, "rotated"},
      {2,
       {"--on", input_ + ":surface", "--displace", "0.1", "--preset", "smoke"},
       "displace takes the noise itself"},
      {2, {"--on", "in.obj"}, "--on is in.obj; it must be FILE.vdb or FILE.vdb:GRID"},
      {2,
       {"--on", input_, "--combine", "mix"},
       "--combine is mix; it must be one of replace, add, multiply, erode"},
      {2, {"--on", input_, "--amount", "x"}, "--amount is x"},
      {2, {"--on", input_, "--combine", "erode", "--amount", "-1"}, "--amount is -1"},
      {2, {"--on", input_, "--combine", "replace", "--amount", "1"}, "--amount has no effect"},
      {2, {"--on", input_, "--combine", "add", "--displace", "1"}, "contradict"},
      {2, {"--on", input_, "--shape", "box"}, "contradict"},
      {2, {"--on", input_, "--voxel", "0.1"}, "--voxel has no effect"},
      {2, {"--on", input_, "--grid", "x"}, "--grid has no effect"},
      {2, {"--on", input_, "--density", "1"}, "--density has no effect"},
      {2, {"--mask", input_}, "--mask has no effect without --on"},
      {2, {"--displace", "1"}, "--displace has no effect without --on"},
      {2, {"--combine", "add"}, "--combine has no effect without --on"},
  };
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> arguments = refusal.arguments;
    arguments.insert(arguments.end(), {"--out", out("x.vdb"), "--quiet"});
    const ToolResult result = run_vdbnoise(arguments);
    EXPECT_EQ(result.status, refusal.status) << refusal.says << ": " << result.err;
    EXPECT_NE(result.err.find(refusal.says), std::string::npos)
        << "lacks " << refusal.says << ": " << result.err;
    EXPECT_EQ(folder_.names(), before) << refusal.says;
    std::filesystem::remove(out("x.vdb"));
  }
}

// OpenVDB's own program and Python module, where they are installed.
TEST_F(Modify, ReadsAndWritesFilesOfOpenVdbsOwnTools) {
  const std::string python = "/usr/bin/python3 -c ";
  const bool has_tools =
      std::system(
          (python + "'import pyopenvdb' 2>/dev/null && vdb_print --version >/dev/null 2>&1").c_str()) == 0;
  if (!has_tools) GTEST_SKIP() << "vdb_print or pyopenvdb is not installed";
  const std::string ball = out("ball.vdb");
  ASSERT_EQ(
      std::system(
          (python +
           "\"import pyopenvdb as v; g=v.createLevelSetSphere(radius=1.0,voxelSize=0.05); g.name='ball'; "
           "g['by']='python'; v.write('" +
           ball + "',grids=[g],metadata={'shot':'b20'})\"")
              .c_str()),
      0);
  run_well({"--on", ball, "--displace", "0.05", "--frequency", "0.8"}, "moved.vdb");
  EXPECT_EQ(std::system(("vdb_print -l " + out("moved.vdb") + " | grep -q 'class: level set'").c_str()), 0);
  EXPECT_EQ(std::system((python + "\"import pyopenvdb as v; g,m=v.readAll('" + out("moved.vdb") +
                         "'); assert m['shot']=='b20' and g[0].name=='ball' and g[0]['by']=='python'; "
                         "assert g[0].gridClass=='level set' and abs(g[0].background-0.15)<1e-6 and "
                         "g[0].activeVoxelCount()>10000\"")
                            .c_str()),
            0);
}

}  // namespace
}  // namespace solidnoise::modify_test
