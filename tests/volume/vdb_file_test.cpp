#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/wave_field.h"

namespace solidnoise {
namespace {

openvdb::FloatGrid::Ptr wave_grid(double radius = 1.0) {
  const WaveField field(Vec<3>(1.0, 2.0, 3.0));
  const auto grid =
      fill_grid(sphere_topology(GridFrame(0.1), Vec<3>(0.0), radius), field, Sparsity::keep).grid;
  set_fog_volume(*grid, "density", "tests");
  return grid;
}

bool same_values(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  if (!a.tree().hasSameTopology(b.tree())) return false;
  for (auto value = a.cbeginValueAll(); value; ++value) {
    if (b.tree().getValue(value.getCoord()) != *value) return false;
  }
  return true;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// What write_vdb says when it refuses.
std::string refusal(const std::filesystem::path& path, const VdbWriteOptions& options = {}) {
  return message_of<std::runtime_error>([&] { write_vdb(path, {wave_grid()}, options); });
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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
  const std::string bytes = read_bytes(folder / "a.vdb");
  EXPECT_EQ(bytes, read_bytes(folder / "b.vdb"));
  grid->tree().setValue(openvdb::Coord(1, 2, 3), 0.5f);
  write_vdb(folder / "c.vdb", {grid}, {.creator = "tests 1"});
  constexpr std::size_t kHeader = 57;  // magic, versions, one byte, and the UUID of 36
  EXPECT_NE(bytes.substr(0, kHeader), read_bytes(folder / "c.vdb").substr(0, kHeader));
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

TEST(ReadVdb, RefusesVoxelsWhoseDistanceHasNoIndex) {
  const TemporaryFolder folder;
  const auto path = folder / "far.vdb";
  const auto grid = openvdb::FloatGrid::create();
  for (const int x : {-(1 << 30), 1 << 30}) grid->tree().setValue(openvdb::Coord(x, 0, 0), 1.0f);
  write_vdb(path, {grid}, {});
  const auto says = [&](const auto& read) { return message_of<std::runtime_error>(read); };
  for (const std::string& message : {says([&] { read_float_grid(path); }), says([&] { read_grids(path); }),
                                     says([&] { read_vdb_summary(path); })}) {
    EXPECT_TRUE(contains(message, path.string() + ": ")) << message;
    EXPECT_TRUE(contains(message, "voxels of index -1073741824 to 1073741824")) << message;
  }
}

TEST(WriteVdb, RefusesAnExistingFileUnlessItIsToBeReplaced) {
  const TemporaryFolder folder;
  const auto path = folder / "cloud.vdb";
  write_bytes(path, "precious");
  EXPECT_THROW(write_vdb(path, {wave_grid()}, {}), OutputExists);
  EXPECT_TRUE(contains(refusal(path), "cloud.vdb: exists already"));
  EXPECT_EQ(read_bytes(path), "precious");
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
  write_bytes(folder / "file", "x");
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
  write_bytes(folder / "target.vdb", "old");
  std::filesystem::create_symlink(folder / "target.vdb", folder / "link.vdb");
  write_vdb(folder / "link.vdb", {wave_grid()}, {.existing = Existing::replace});
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.vdb"));
  EXPECT_NO_THROW(read_float_grid(folder / "target.vdb"));
}

TEST(WriteVdb, ReportsAFullDiskAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  write_bytes(folder / "old.vdb", "precious");
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
  EXPECT_EQ(read_bytes(folder / "old.vdb"), "precious");
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

TEST(ReadVdb, NamesFilesThatAreNotGrids) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::filesystem::path& path) {
    return message_of<std::runtime_error>([&] { read_vdb_summary(path); });
  };
  EXPECT_TRUE(contains(refused(folder / "none.vdb"), "none.vdb: cannot be read: No such file"));
  EXPECT_TRUE(contains(refused(folder / ""), "is a folder"));
  write_bytes(folder / "empty.vdb", "");
  EXPECT_TRUE(contains(refused(folder / "empty.vdb"), "empty.vdb: is not a .vdb, or damaged"));
  write_bytes(folder / "text.vdb", "just some text, but more than twenty bytes of it");
  EXPECT_TRUE(contains(refused(folder / "text.vdb"), "text.vdb: is not a .vdb, or damaged"));
  write_vdb(folder / "zero.vdb", {}, {});
  EXPECT_TRUE(contains(refused(folder / "zero.vdb"), "zero.vdb: holds no grids"));
}

// Reading it may succeed, or fail as documented; anything else ends the test program.
bool reads(const std::filesystem::path& path) {
  try {
    read_vdb_summary(path);
    read_float_grid(path, "density");
    return true;
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(contains(error.what(), path.filename().string())) << error.what();
    return false;
  }
}

TEST(ReadVdb, RefusesAFileThatIsCutAnywhere) {
  const TemporaryFolder folder;
  write_vdb(folder / "whole.vdb", {wave_grid(0.5)}, {.codec = Codec::none});
  const std::string whole = read_bytes(folder / "whole.vdb");
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 50) {
    write_bytes(folder / "cut.vdb", whole.substr(0, length));
    EXPECT_FALSE(reads(folder / "cut.vdb")) << length << " of " << whole.size();
  }
}

TEST(ReadVdb, SurvivesDamagedBytes) {
  const TemporaryFolder folder;
  const auto grid = wave_grid(0.3);
  std::mt19937_64 random(1);
  for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
    grid->setSaveFloatAsHalf(codec == Codec::blosc);
    grid->setGridClass(openvdb::GRID_UNKNOWN);  // zip is not used on fog volumes
    write_vdb(folder / "whole.vdb", {grid}, {.codec = codec, .existing = Existing::replace});
    const std::string whole = read_bytes(folder / "whole.vdb");
    int refused = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::string damaged = whole;
      // The first kilobyte holds metadata; masks, sizes and values follow.
      const std::size_t byte = random() % std::min<std::size_t>(damaged.size(), trial % 2 == 0 ? 1000 : ~0u);
      damaged[byte] = trial % 4 < 2 ? static_cast<char>(random()) : static_cast<char>(~damaged[byte]);
      write_bytes(folder / "damaged.vdb", damaged);
      refused += !reads(folder / "damaged.vdb");
    }
    EXPECT_GT(refused, 40);  // so that the errors' path was tried
  }
}

TEST(ReadVdb, RefusesAChunkOfValuesThatIsLargerThanItsMemory) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->tree().setValueOn(openvdb::Coord(1), 2.0f);
  write_vdb(folder / "whole.vdb", {grid}, {.codec = Codec::blosc});
  std::string bytes = read_bytes(folder / "whole.vdb");
  // The file ends with the leaf's chunk: its size, then Blosc's header of 16 bytes and the only value.
  const std::size_t chunk = 16 + sizeof(float);
  const std::size_t at = bytes.size() - chunk - sizeof(std::int64_t);
  std::int64_t size = 0;
  std::memcpy(&size, bytes.data() + at, sizeof(size));
  ASSERT_EQ(size, static_cast<std::int64_t>(chunk));
  size = -1000000;  // negative: so many bytes that are not compressed
  std::memcpy(bytes.data() + at, &size, sizeof(size));
  write_bytes(folder / "damaged.vdb", bytes + std::string(1000000, 'x'));
  const auto refusal = message_of<std::runtime_error>([&] { read_grid(folder / "damaged.vdb"); });
  EXPECT_TRUE(contains(refusal, "damaged.vdb: is not a .vdb, or damaged: a chunk of values has a wrong size"))
      << refusal;
}

TEST(ReadVdb, RefusesAFileOfANewerVersion) {
  const TemporaryFolder folder;
  write_vdb(folder / "whole.vdb", {wave_grid(0.3)}, {});
  std::string bytes = read_bytes(folder / "whole.vdb");
  ++bytes[sizeof(std::int64_t)];  // the version follows the magic number
  write_bytes(folder / "newer.vdb", bytes);
  const auto refusal = message_of<std::runtime_error>([&] { read_vdb_summary(folder / "newer.vdb"); });
  EXPECT_TRUE(contains(refusal, "newer.vdb: is not a .vdb, or damaged: it was written by an OpenVDB newer"))
      << refusal;
}

TEST(ReadVdb, ReadsGridsThatShareATree) {
  const TemporaryFolder folder;
  const auto density = wave_grid(0.5);
  const auto shared = density->copy();
  shared->setName("shared");
  write_vdb(folder / "two.vdb", {density, shared}, {});
  EXPECT_TRUE(same_values(*read_float_grid(folder / "two.vdb", "density"), *density));
  EXPECT_TRUE(same_values(*read_float_grid(folder / "two.vdb", "shared"), *density));
}

TEST(ReadVdb, ReadsGridsOfEveryUsualType) {
  const TemporaryFolder folder;
  const auto roundtrip = [&]<typename GridType>(typename GridType::Ptr grid) {
    grid->setName("grid");
    grid->tree().addTile(2, openvdb::Coord(512), grid->background(), true);
    for (int i = 0; i < 40; ++i) grid->tree().setActiveState(openvdb::Coord(3 * i, i * i, -i), true);
    for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
      write_vdb(folder / "grid.vdb", {grid}, {.codec = codec, .existing = Existing::replace});
      const auto read = openvdb::gridPtrCast<GridType>(read_grid(folder / "grid.vdb"));
      ASSERT_NE(read, nullptr) << grid->type();
      EXPECT_TRUE(read->tree().hasSameTopology(grid->tree())) << grid->type();
    }
  };
  roundtrip.operator()<openvdb::BoolGrid>(openvdb::BoolGrid::create(false));
  roundtrip.operator()<openvdb::MaskGrid>(openvdb::MaskGrid::create(false));
  roundtrip.operator()<openvdb::Int32Grid>(openvdb::Int32Grid::create(1));
  roundtrip.operator()<openvdb::Int64Grid>(openvdb::Int64Grid::create(1));
  roundtrip.operator()<openvdb::DoubleGrid>(openvdb::DoubleGrid::create(1.0));
  roundtrip.operator()<openvdb::Vec3IGrid>(openvdb::Vec3IGrid::create(openvdb::Vec3i(1)));
  roundtrip.operator()<openvdb::Vec3SGrid>(openvdb::Vec3SGrid::create(openvdb::Vec3s(1)));
  roundtrip.operator()<openvdb::Vec3DGrid>(openvdb::Vec3DGrid::create(openvdb::Vec3d(1)));
}

}  // namespace
}  // namespace solidnoise
