#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "solidnoise/volume/describe_volume.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/slice/slice_field.h"
#include "solidnoise/volume/vdb/nvdb_write.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "volume/wave_grid.h"

namespace solidnoise::read_vdb_test {
namespace {

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

TEST(ReadVdb, ShowsNamesOfGridsWithoutWhatTurnsTheDirectionOfWriting) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create();
  grid->setName("a\u202eb");
  write_vdb(folder / "a.vdb", {grid}, {});
  const std::string message =
      message_of<std::runtime_error>([&] { read_float_grid(folder / "a.vdb", "density"); });
  EXPECT_TRUE(contains(message, "'a\\xe2\\x80\\xaeb'")) << message;
}

// Asks to stop at the nth question.
class Stop final : public Progress {
 public:
  explicit Stop(int at) : left_(at) {}
  void advance(std::uint64_t, std::uint64_t) override {}
  bool cancelled() override { return --left_ <= 0; }

 private:
  int left_;
};

TEST(ReadVdb, StopsWhereItIsAskedTo) {
  const TemporaryFolder folder;
  const openvdb::FloatGrid::Ptr grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      60.0f, openvdb::Vec3f(0.0f), 1.0f, openvdb::LEVEL_SET_HALF_WIDTH);
  write_vdb(folder / "a.vdb", {grid}, {});
  write_nvdb(folder / "a.nvdb", {grid}, {});
  for (const char* const name : {"a.vdb", "a.nvdb"}) {
    const GridFile file{.file = folder.file(name)};
    VolumeRecipe shape;
    shape.shape = file;
    VolumeRecipe on;
    on.modification.emplace();
    on.modification->on = file;
    VolumeRecipe boundary;
    boundary.output = {Output::curl};
    boundary.boundary = file;
    VolumeRecipe parameter;
    parameter.parameters.magnitude.emplace();
    parameter.parameters.magnitude->source = file;
    SliceRecipe slice;
    slice.file = file.file;
    for (const int question : {1, 3}) {
      const auto stops = [&](const auto& read) {
        Stop stop(question);
        EXPECT_THROW(read(&stop), Cancelled) << name << question;
      };
      stops([&](Progress* stop) { read_grids(file.file, stop); });
      stops([&](Progress* stop) { read_grid(file.file, {}, stop); });
      stops([&](Progress* stop) { read_float_grid(file.file, {}, stop); });
      stops([&](Progress* stop) { make_slice_field(slice, stop); });
      for (const VolumeRecipe& recipe : {shape, on, boundary, parameter}) {
        stops([&](Progress* stop) { plan_volume(recipe, {}, stop); });
        stops([&](Progress* stop) { describe_volume(recipe, {.progress = stop}); });
      }
    }
  }
}

TEST(ReadVdb, NamesFilesThatAreNotGrids) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::filesystem::path& path) {
    return message_of<std::runtime_error>([&] { read_vdb_summary(path); });
  };
  EXPECT_TRUE(contains(refused(folder / "none.vdb"), "none.vdb: cannot be read: No such file"));
  EXPECT_TRUE(contains(refused(folder / ""), "is a folder"));
  folder.write("empty.vdb", "");
  EXPECT_TRUE(contains(refused(folder / "empty.vdb"), "empty.vdb: is not a .vdb, or damaged"));
  folder.write("text.vdb", "just some text, but more than twenty bytes of it");
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
  const std::string whole = folder.read("whole.vdb");
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 50) {
    folder.write("cut.vdb", whole.substr(0, length));
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
    const std::string whole = folder.read("whole.vdb");
    int refused = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::string damaged = whole;
      // The first kilobyte holds metadata; masks, sizes and values follow.
      const std::size_t byte = random() % std::min<std::size_t>(damaged.size(), trial % 2 == 0 ? 1000 : ~0u);
      damaged[byte] = trial % 4 < 2 ? static_cast<char>(random()) : static_cast<char>(~damaged[byte]);
      folder.write("damaged.vdb", damaged);
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
  std::string bytes = folder.read("whole.vdb");
  // The file ends with the leaf's chunk: its size, then Blosc's header of 16 bytes and the only value.
  const std::size_t chunk = 16 + sizeof(float);
  const std::size_t at = bytes.size() - chunk - sizeof(std::int64_t);
  std::int64_t size = 0;
  std::memcpy(&size, bytes.data() + at, sizeof(size));
  ASSERT_EQ(size, static_cast<std::int64_t>(chunk));
  size = -1000000;  // negative: so many bytes that are not compressed
  std::memcpy(bytes.data() + at, &size, sizeof(size));
  folder.write("damaged.vdb", bytes + std::string(1000000, 'x'));
  const auto refusal = message_of<std::runtime_error>([&] { read_grid(folder / "damaged.vdb"); });
  EXPECT_TRUE(contains(refusal, "damaged.vdb: is not a .vdb, or damaged: a chunk of values has a wrong size"))
      << refusal;
}

// OpenVDB reads as many bytes as the type has, and takes what follows for the next size.
TEST(ReadVdb, RefusesMetadataThatAreNotOfTheirTypesSize) {
  const TemporaryFolder folder;
  const auto grid = wave_grid(0.3);
  set_metadata(*grid, {{"an integer", std::int64_t{0x7fffffff}}});
  write_vdb(folder / "whole.vdb", {grid}, {});
  std::string bytes = folder.read("whole.vdb");
  const std::string type = "an integer" + std::string("\5\0\0\0int64", 9);
  bytes.replace(bytes.find(type) + type.size() - 5, 5, "int32");
  folder.write("damaged.vdb", bytes);
  const auto refusal = message_of<std::runtime_error>([&] { read_vdb_summary(folder / "damaged.vdb"); });
  EXPECT_TRUE(contains(refusal, "damaged: a value of type int32 in its metadata has a wrong size"))
      << refusal;
}

// A grid's descriptor says where its leaves' values are: OpenVDB goes there, whatever stands there.
TEST(ReadVdb, RefusesValuesThatAreElsewhere) {
  const TemporaryFolder folder;
  write_vdb(folder / "whole.vdb", {wave_grid(0.3)}, {});
  std::string bytes = folder.read("whole.vdb");
  // Behind the type's name: the parent's, which is empty, and where the grid, its values and its end are.
  const std::string type = "Tree_float_5_4_3";
  const std::size_t at = bytes.find(type) + type.size() + sizeof(std::uint32_t) + sizeof(std::int64_t);
  std::int64_t position = 0;
  std::memcpy(&position, bytes.data() + at, sizeof(position));
  position -= 2;
  std::memcpy(bytes.data() + at, &position, sizeof(position));
  folder.write("damaged.vdb", bytes);
  const auto refusal = message_of<std::runtime_error>([&] { read_grid(folder / "damaged.vdb"); });
  EXPECT_TRUE(contains(refusal, "a grid's values are not where it says")) << refusal;
}

// A truth value of any other byte is no value of bool, and whatever is done with it undefined.
TEST(ReadVdb, RefusesATruthValueThatIsNone) {
  const TemporaryFolder folder;
  const auto grid = wave_grid(0.3);
  grid->insertMeta("a truth", openvdb::BoolMetadata(true));
  write_vdb(folder / "whole.vdb", {grid}, {});
  std::string bytes = folder.read("whole.vdb");
  const std::string before = "a truth" + std::string("\4\0\0\0bool\1\0\0\0", 12);
  bytes[bytes.find(before) + before.size()] = '!';
  folder.write("damaged.vdb", bytes);
  const auto refusal = message_of<std::runtime_error>([&] { read_vdb_summary(folder / "damaged.vdb"); });
  EXPECT_TRUE(contains(refusal, "a value of type bool in its metadata is neither 0 nor 1")) << refusal;
}

// What OpenVDB before version 13 writes for readers that load leaves when they are asked for.
TEST(ReadVdb, ReadsListsForDelayedLoadingAndRefusesThoseOfWrongSizes) {
  const TemporaryFolder folder;
  openvdb::initialize();
  const auto grid = wave_grid(4.0);  // of so many leaves that their lists are compressed
  openvdb::io::File(folder / "whole.vdb").write(openvdb::GridCPtrVec{grid});
  EXPECT_TRUE(same_values(*read_float_grid(folder / "whole.vdb"), *grid));
  const std::string whole = folder.read("whole.vdb");
  const std::string type = "__delayedload";
  const std::size_t size = whole.find(type) + type.size();
  ASSERT_LT(size, whole.size());
  // Behind the size: how many leaves, how many bytes, and Blosc's header with the number there were.
  for (const std::size_t field : {1, 2, 4}) {
    std::string bytes = whole;
    const std::uint32_t huge = 0x40000000;
    std::memcpy(bytes.data() + size + field * sizeof huge, &huge, sizeof huge);
    folder.write("damaged.vdb", bytes);
    const auto refusal = message_of<std::runtime_error>([&] { read_vdb_summary(folder / "damaged.vdb"); });
    EXPECT_TRUE(
        contains(refusal, field == 2 ? "ends too early" : "__delayedload in its metadata has a wrong"))
        << field << ": " << refusal;
  }
}

TEST(ReadVdb, RefusesARootThatIsNone) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create();
  for (const int x : {0, 4096}) grid->tree().root().addTile(openvdb::Coord(x, 0, 0), 0.25f, true);
  write_vdb(folder / "whole.vdb", {grid}, {});
  EXPECT_EQ(read_float_grid(folder / "whole.vdb")->activeVoxelCount(), 2ull << 36);
  const std::string whole = folder.read("whole.vdb");
  // The file ends with the tiles: three coordinates, the value, and a byte that says whether it is active.
  const auto refusal_with = [&](std::size_t from_end, std::int32_t value) {
    std::string bytes = whole;
    std::memcpy(bytes.data() + bytes.size() - from_end, &value, from_end == 1 ? 1 : sizeof value);
    folder.write("damaged.vdb", bytes);
    return message_of<std::runtime_error>([&] { read_grid(folder / "damaged.vdb"); });
  };
  EXPECT_TRUE(contains(refusal_with(1, 228), "a tile is neither active nor inactive"));
  EXPECT_TRUE(contains(refusal_with(17, 4097), "a node begins where none can"));
  EXPECT_TRUE(contains(refusal_with(17, 0), "two nodes have the same place"));
}

TEST(ReadVdb, RefusesAFileOfANewerVersion) {
  const TemporaryFolder folder;
  write_vdb(folder / "whole.vdb", {wave_grid(0.3)}, {});
  std::string bytes = folder.read("whole.vdb");
  ++bytes[sizeof(std::int64_t)];  // the version follows the magic number
  folder.write("newer.vdb", bytes);
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
}  // namespace solidnoise::read_vdb_test
