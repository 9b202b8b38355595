#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "volume/wave_grid.h"

namespace solidnoise::vdb_file_test {
namespace {

// What write_vdb says when it refuses.
std::string refusal(const std::filesystem::path& path, const VdbWriteOptions& options = {}) {
  return message_of<std::runtime_error>([&] { write_vdb(path, {wave_grid()}, options); });
}

TEST(VdbFile, KeepsValuesTopologyFrameAndMetadata) {
  const TemporaryFolder folder;
  const auto grid = wave_grid();
  set_metadata(*grid, {{"text", std::string("a \"b\" \n c")},
                       {"integer", std::int64_t{1} << 40},
                       {"real", 0.1},
                       {"flag", true}});
  for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
    const auto path = folder / "cloud.vdb";
    write_vdb(path, {grid},
              {.codec = codec, .existing = Existing::replace, .creator = "tests 1", .frame = 7, .fps = 24.0});
    const auto read = read_float_grid(path, "density");
    EXPECT_TRUE(same_values(*grid, *read));
    EXPECT_EQ(read->transform(), grid->transform());
    EXPECT_EQ(read->getGridClass(), openvdb::GRID_FOG_VOLUME);
    EXPECT_EQ(read->metaValue<std::string>("text"), "a \"b\" \n c");
    EXPECT_EQ(read->metaValue<std::int64_t>("integer"), std::int64_t{1} << 40);
    EXPECT_EQ(read->metaValue<double>("real"), 0.1);
    EXPECT_EQ(read->metaValue<bool>("flag"), true);

    const VdbSummary summary = read_vdb_summary(path);
    EXPECT_EQ(summary.metadata.at("creator"), "tests 1");
    EXPECT_EQ(summary.metadata.at("frame"), "7");
    EXPECT_EQ(summary.metadata.at("fps"), "24");
    ASSERT_EQ(summary.grids.size(), 1u);
    EXPECT_EQ(summary.grids[0].name, "density");
    EXPECT_EQ(summary.grids[0].value_type, "float");
    EXPECT_EQ(summary.grids[0].grid_class, "fog volume");
    EXPECT_EQ(summary.grids[0].voxel_size, Vec<3>(0.1));
    EXPECT_EQ(summary.grids[0].active_voxels, grid->activeVoxelCount());
    EXPECT_EQ(summary.grids[0].voxel_bounds, grid->evalActiveVoxelBoundingBox());
    EXPECT_EQ(summary.grids[0].metadata.at("real"), "0.1");
  }
  EXPECT_EQ(folder.count(), 1u);  // no temporary file is left
}

TEST(VdbFile, HoldsHalfFloatsWhenTheGridAsksForThem) {
  const TemporaryFolder folder;
  const auto grid = wave_grid();
  write_vdb(folder / "full.vdb", {grid}, {.codec = Codec::none});
  grid->setSaveFloatAsHalf(true);
  write_vdb(folder / "half.vdb", {grid}, {.codec = Codec::none});
  const auto read = read_float_grid(folder / "half.vdb");
  for (auto value = grid->cbeginValueOn(); value; ++value) {
    // A half has 11 significant bits.
    const float rounded = read->tree().getValue(value.getCoord());
    EXPECT_NEAR(rounded, *value, std::ldexp(std::abs(*value), -11) + 1e-7f);
  }
  EXPECT_TRUE(read_vdb_summary(folder / "half.vdb").grids[0].saved_as_half);
  const auto saved = static_cast<double>(std::filesystem::file_size(folder / "full.vdb")) -
                     static_cast<double>(std::filesystem::file_size(folder / "half.vdb"));
  // Two bytes for each active value, but for the metadata that says so.
  EXPECT_NEAR(saved, 2.0 * static_cast<double>(grid->activeVoxelCount()), 100.0);
}

TEST(VdbFile, HoldsSeveralGridsThatAreReadByName) {
  const TemporaryFolder folder;
  const auto density = wave_grid();
  const auto heat = wave_grid(0.5);
  heat->setName("temperature");
  const auto velocity = openvdb::Vec3SGrid::create();
  velocity->setName("vel");
  velocity->tree().setValueOn(openvdb::Coord(1), openvdb::Vec3s(1));
  const auto path = folder / "many.vdb";
  write_vdb(path, {velocity, density, heat}, {});
  EXPECT_EQ(read_vdb_summary(path).grids.size(), 3u);
  EXPECT_TRUE(same_values(*read_float_grid(path, "temperature"), *heat));
  EXPECT_TRUE(same_values(*read_float_grid(path), *density));  // the first of floats
  EXPECT_EQ(read_grid(path)->getName(), "vel");
  EXPECT_EQ(read_grid(path, "vel")->valueType(), "vec3s");

  const auto missing = message_of<std::runtime_error>([&] { read_grid(path, "fuel"); });
  EXPECT_TRUE(contains(missing, "many.vdb: has no grid 'fuel'; it has 'vel' (vec3s), 'density' (float)"))
      << missing;
  const auto wrong = message_of<std::runtime_error>([&] { read_float_grid(path, "vel"); });
  EXPECT_TRUE(contains(wrong, "no grid of floats 'vel'")) << wrong;
}

TEST(VdbFile, ThatWasStreamedIsReadByNameToo) {
  const TemporaryFolder folder;
  const auto grid = wave_grid();
  {
    std::ofstream stream(folder / "streamed.vdb", std::ios::binary);
    write_vdb(stream, {grid}, {});
  }
  EXPECT_TRUE(same_values(*read_float_grid(folder / "streamed.vdb", "density"), *grid));
  EXPECT_EQ(read_vdb_summary(folder / "streamed.vdb").grids[0].active_voxels, grid->activeVoxelCount());
}

TEST(WriteVdb, WritesTheSameBytesAgainAndOthersForOtherValues) {
  const TemporaryFolder folder;
  const auto grid = wave_grid();
  write_vdb(folder / "a.vdb", {grid}, {.creator = "tests 1"});
  write_vdb(folder / "b.vdb", {grid->deepCopy()}, {.creator = "tests 1"});
  const std::string bytes = folder.read("a.vdb");
  EXPECT_EQ(bytes, folder.read("b.vdb"));
  grid->tree().setValue(openvdb::Coord(1, 2, 3), 0.5f);
  write_vdb(folder / "c.vdb", {grid}, {.creator = "tests 1"});
  constexpr std::size_t kHeader = 57;  // magic, versions, one byte, and the UUID of 36
  EXPECT_NE(bytes.substr(0, kHeader), folder.read("c.vdb").substr(0, kHeader));
}

TEST(WriteVolume, RefusesValuesThatAreNotFiniteAsTheyAreStored) {
  const TemporaryFolder folder;
  const auto refusal_of = [&](float value, bool active, bool half) {
    const auto grid = wave_grid();
    active ? grid->tree().setValue(openvdb::Coord(1, 2, 3), value)
           : grid->tree().setValueOff(openvdb::Coord(1, 2, 3), value);
    grid->setSaveFloatAsHalf(half);
    return message_of<std::runtime_error>([&] {
      write_volume(folder / "a.vdb", {{{grid, {}}}}, {.existing = Existing::replace});
    });
  };
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::string begin =
      (folder / "a.vdb").string() + ": not written: grid 'density' has 1 values that are not ";
  EXPECT_EQ(refusal_of(kInfinity, true, false), begin + "finite, the first at voxel (1, 2, 3)");
  EXPECT_EQ(refusal_of(NAN, false, false), begin + "finite, the first at voxel (1, 2, 3)");
  EXPECT_EQ(refusal_of(-65505.0f, true, true),
            begin + "finite as 16-bit floats, the first at voxel (1, 2, 3)");
  EXPECT_EQ(refusal_of(65504.0f, true, true), "nothing was thrown");
  EXPECT_EQ(refusal_of(65505.0f, true, false), "nothing was thrown");
}

TEST(WriteVdb, RefusesAnExistingFileUnlessItIsToBeReplaced) {
  const TemporaryFolder folder;
  const auto path = folder / "cloud.vdb";
  folder.write("cloud.vdb", "precious");
  EXPECT_THROW(write_vdb(path, {wave_grid()}, {}), OutputExists);
  EXPECT_TRUE(contains(refusal(path), "cloud.vdb: exists already"));
  EXPECT_EQ(folder.read("cloud.vdb"), "precious");
  write_vdb(path, {wave_grid()}, {.existing = Existing::replace});
  EXPECT_NO_THROW(read_float_grid(path));
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteVdb, RefusesWhatCannotBeAFileOfOurs) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(refusal(folder / "no/cloud.vdb"), "there is no folder"));
  EXPECT_TRUE(contains(refusal(folder / ""), "is a folder"));
  EXPECT_TRUE(
      contains(refusal("/dev/null", {.existing = Existing::replace}), "/dev/null: is not a regular file"));
  folder.write("file", "x");
  EXPECT_TRUE(contains(refusal(folder / "file/cloud.vdb"), "file/cloud.vdb: there is no folder"));
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteVdb, TakesFileNamesOfAnyLengthTheSystemAllows) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string(251, 'x') + ".vdb");
  write_vdb(path, {wave_grid()}, {});
  EXPECT_NO_THROW(read_float_grid(path));
  const auto too_long = folder / (std::string(252, 'x') + ".vdb");
  EXPECT_TRUE(contains(refusal(too_long), "cannot be written"));
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteVdb, WritesThroughALink) {
  const TemporaryFolder folder;
  folder.write("target.vdb", "old");
  std::filesystem::create_symlink(folder / "target.vdb", folder / "link.vdb");
  write_vdb(folder / "link.vdb", {wave_grid()}, {.existing = Existing::replace});
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.vdb"));
  EXPECT_NO_THROW(read_float_grid(folder / "target.vdb"));
}

TEST(WriteVdb, ReportsAFullDiskAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  folder.write("old.vdb", "precious");
  // A limit on the size of files does what a full disk does: write() fails in the middle.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string fresh = refusal(folder / "cloud.vdb");
  const std::string replaced = refusal(folder / "old.vdb", {.existing = Existing::replace});
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_TRUE(contains(fresh, "cloud.vdb: writing failed: ")) << fresh;
  EXPECT_TRUE(contains(replaced, "old.vdb: writing failed: ")) << replaced;
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_EQ(folder.read("old.vdb"), "precious");
}

TEST(WriteVdb, ReportsAStreamThatFails) {
  std::ofstream full("/dev/full", std::ios::binary);
  ASSERT_TRUE(full);
  EXPECT_THROW(write_vdb(full, {wave_grid()}, {}), std::runtime_error);
}

TEST(WriteVdb, StopsWhenAskedAndLeavesNothingBehind) {
  class Stop final : public Progress {
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return true; }
  } stop;
  const TemporaryFolder folder;
  EXPECT_THROW(write_vdb(folder / "cloud.vdb", {wave_grid()}, {.progress = &stop}), Cancelled);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace solidnoise::vdb_file_test
