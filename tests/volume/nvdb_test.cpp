#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/nvdb_write.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "support/temporary_folder.h"

namespace solidnoise::nvdb_test {
namespace {

// Smooth values over some leaves, one voxel far away, and a tile of 8^3 voxels.
openvdb::FloatGrid::Ptr some_density() {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create();
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  grid->transform().postTranslate({3.0, 0.0, -2.0});
  auto accessor = grid->getAccessor();
  for (int x = -10; x < 20; ++x) {
    for (int y = 0; y < 12; ++y) {
      for (int z = 0; z < 9; ++z) accessor.setValue({x, y, z}, 2.0f + std::sin(0.3f * x + 0.7f * y * z));
    }
  }
  accessor.setValue({5000, -7, 3}, 0.125f);
  grid->tree().addTile(1, {64, 64, 64}, 0.5f, true);
  return grid;
}

openvdb::FloatGrid::Ptr read_back(const std::filesystem::path& path) {
  return read_float_grid(path);
}

// Half a step of the leaf that a voxel is in, of steps from its least to its greatest value.
double half_a_step(const openvdb::FloatGrid& grid, const openvdb::Coord& at, int bits) {
  const auto* const leaf = grid.tree().probeConstLeaf(at);
  const auto [least, greatest] =
      std::minmax_element(leaf->buffer().data(), leaf->buffer().data() + leaf->SIZE);
  return 0.5 * (static_cast<double>(*greatest) - *least) / ((1 << bits) - 1);
}

TEST(Nvdb, KeepsFloatsVectorsNamesClassesAndPlaces) {
  const TemporaryFolder folder;
  const auto density = some_density();
  const auto velocity = openvdb::Vec3SGrid::create({0.0f, 0.0f, 0.0f});
  velocity->setName("vel");
  velocity->tree().setValueOn({1, 2, 3}, {0.1f, -2.0f, 1e-9f});
  const std::vector<double> errors = write_nvdb(folder.file("a.nvdb"), {density, velocity}, {});
  EXPECT_EQ(errors, (std::vector<double>{0.0, 0.0}));

  const VdbFile file = read_grids(folder.file("a.nvdb"));
  ASSERT_EQ(file.grids.size(), 2u);
  const auto read = openvdb::gridPtrCast<openvdb::FloatGrid>(file.grids[0]);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->getName(), "density");
  EXPECT_EQ(read->getGridClass(), openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(read->transform(), density->transform());
  EXPECT_EQ(read->activeVoxelCount(), density->activeVoxelCount());
  for (auto value = density->cbeginValueOn(); value; ++value) {
    ASSERT_EQ(read->tree().getValue(value.getCoord()), *value) << value.getCoord();
  }
  const auto vectors = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.grids[1]);
  ASSERT_TRUE(vectors);
  EXPECT_EQ(vectors->tree().getValue({1, 2, 3}), openvdb::Vec3f(0.1f, -2.0f, 1e-9f));
  EXPECT_EQ(vectors->activeVoxelCount(), 1u);
}

TEST(Nvdb, QuantisesWithinHalfAStepAndSaysTheError) {
  const TemporaryFolder folder;
  const auto density = some_density();
  std::uintmax_t last_size = std::numeric_limits<std::uintmax_t>::max();
  for (const auto& [values, bits] : {std::pair{NvdbValues::bits16, 16}, std::pair{NvdbValues::bits8, 8},
                                     std::pair{NvdbValues::bits4, 4}}) {
    SCOPED_TRACE(bits);
    const auto path = folder.file(std::to_string(bits) + ".nvdb");
    const double said = write_nvdb(path, {density}, {.values = values}).front();
    const auto read = read_back(path);
    ASSERT_EQ(read->activeVoxelCount(), density->activeVoxelCount());
    double error = 0.0;
    // Codes are computed from floats below 2^bits and decoded in floats below 3: each rounds some times.
    constexpr double kRounding = 8.0 * 3.0 * std::numeric_limits<float>::epsilon();
    for (auto leaf = density->tree().cbeginLeaf(); leaf; ++leaf) {
      for (auto value = leaf->cbeginValueOn(); value; ++value) {
        const openvdb::Coord at = value.getCoord();
        const double difference = std::abs(static_cast<double>(read->tree().getValue(at)) - *value);
        ASSERT_LE(difference, half_a_step(*density, at, bits) + kRounding) << at;
        error = std::max(error, difference);
      }
    }
    EXPECT_EQ(said, error);
    EXPECT_GT(said, 0.0);
    EXPECT_EQ(read->tree().getValue({64, 64, 64}), 0.5f);
    EXPECT_LT(std::filesystem::file_size(path), last_size);
    last_size = std::filesystem::file_size(path);
  }
}

// Whatever byte is wrong, and wherever a file ends: it is refused, or the byte says nothing of the grid.
TEST(Nvdb, IsRefusedWhereItIsDamaged) {
  const TemporaryFolder folder;
  const auto density = openvdb::FloatGrid::create();
  density->setName("density");
  for (int x = 0; x < 40; ++x) density->tree().setValueOn({x, x, 0}, static_cast<float>(x));
  write_nvdb(folder.file("whole.nvdb"), {density}, {.values = NvdbValues::bits8});
  const std::string whole = folder.read("whole.nvdb");
  std::size_t refused = 0;
  std::size_t tried = 0;
  const auto try_bytes = [&](const std::string& bytes) {
    folder.write("damaged.nvdb", bytes);
    ++tried;
    try {
      const auto read = read_back(folder.file("damaged.nvdb"));
      for (int x = 0; x < 40; ++x) {
        EXPECT_NEAR(read->tree().getValue({x, x, 0}), x, 0.5 * 39 / 255 + 1e-5);
      }
    } catch (const std::runtime_error& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("damaged.nvdb"), std::string::npos) << error.what();
    }
  };
  for (std::size_t at = 0; at < whole.size(); at += at < 2000 ? 7 : 4099) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    try_bytes(bytes);
    try_bytes(whole.substr(0, at));
  }
  EXPECT_GT(refused, tried / 2);

  // Offsets that lead out of the file, with a checksum that is switched off.
  const std::size_t header = 16 + 176 + std::strlen("density") + 1;
  for (const std::size_t tree_field : {0u, 8u, 16u, 24u, 32u, 36u, 40u}) {
    std::string bytes = whole;
    const std::uint64_t none = ~std::uint64_t{0};
    std::memcpy(&bytes[header + 8], &none, sizeof(none));
    const std::uint32_t far = 0x7ffffff0;
    std::memcpy(&bytes[header + 672 + tree_field], &far, sizeof(far));
    folder.write("damaged.nvdb", bytes);
    EXPECT_THROW(read_back(folder.file("damaged.nvdb")), std::runtime_error) << tree_field;
  }

  // A name that is said to stand behind the voxels.
  std::string bytes = whole;
  const std::uint64_t none = ~std::uint64_t{0};
  std::memcpy(&bytes[header + 8], &none, sizeof(none));
  bytes[header + 20] = static_cast<char>(bytes[header + 20] | 1);
  folder.write("damaged.nvdb", bytes);
  EXPECT_THROW(read_back(folder.file("damaged.nvdb")), std::runtime_error);
}

TEST(Nvdb, IsNotWrittenOfWhatItCannotKeep) {
  const TemporaryFolder folder;
  openvdb::initialize();
  const auto numbers = openvdb::Int32Grid::create();
  numbers->setName("ids");
  const auto message_of = [&](const openvdb::GridBase::Ptr& grid) -> std::string {
    try {
      write_nvdb(folder.file("a.nvdb"), {some_density(), grid}, {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message_of(numbers).find("grid 'ids' cannot be written as NanoVDB: its values are int32"),
            std::string::npos);
  const auto named = some_density();
  named->setName(std::string(256, 'x'));
  EXPECT_NE(message_of(named).find("255 bytes"), std::string::npos);
  const auto frustum = some_density();
  frustum->setTransform(
      openvdb::math::Transform::createFrustumTransform({{0, 0, 0}, {10, 10, 10}}, 0.5, 10.0));
  EXPECT_NE(message_of(frustum).find("not affine"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.nvdb")));
}

}  // namespace
}  // namespace solidnoise::nvdb_test
