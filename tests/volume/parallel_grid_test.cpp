#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <openvdb/io/Compression.h>
#include <tbb/global_control.h>

#include "solidnoise/volume/vdb/grid_archive.h"

namespace solidnoise::parallel_grid_test {
namespace {

// What OpenVDB writes of a grid: its topology, which tells the stream the background, and its values.
std::string written(const openvdb::GridBase& grid, std::uint32_t compression) {
  std::ostringstream stream;
  openvdb::io::setDataCompression(stream, compression);
  grid.writeTopology(stream);
  grid.writeBuffers(stream);
  return std::move(stream).str();
}

// Of 343 leaves, some of them nearly empty and one full, and a tile.
template <typename Grid>
typename Grid::Ptr some_grid(const typename Grid::ValueType& background) {
  openvdb::initialize();
  const auto grid = Grid::create(background);
  auto accessor = grid->getAccessor();
  int count = 0;
  const openvdb::CoordBBox box(openvdb::Coord(-20), openvdb::Coord(31));
  for (auto voxel = box.begin(); voxel; ++voxel) {
    if (++count % 3 == 0)
      accessor.setValue(*voxel, typename Grid::ValueType(0.001f * float(count * 37 % 1009)));
  }
  for (auto voxel = openvdb::CoordBBox::createCube(openvdb::Coord(8), 8).begin(); voxel; ++voxel)
    accessor.setValue(*voxel, typename Grid::ValueType(0.001f * float(++count % 1009)));
  grid->tree().addTile(1, openvdb::Coord(64), typename Grid::ValueType(2.0f), true);
  return grid;
}

template <typename Grid>
void expect_same_bytes(const typename Grid::Ptr& grid) {
  using namespace openvdb::io;
  for (const std::uint32_t compression :
       {std::uint32_t{COMPRESS_NONE}, std::uint32_t{COMPRESS_ACTIVE_MASK},
        std::uint32_t{COMPRESS_ACTIVE_MASK | COMPRESS_BLOSC}, std::uint32_t{COMPRESS_ZIP}}) {
    const std::string expected = written(*grid, compression);
    for (const int threads : {1, 3}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      EXPECT_TRUE(written(*parallel_grid(grid), compression) == expected) << compression << ", " << threads;
    }
  }
}

TEST(ParallelGrid, WritesTheBytesThatOpenvdbDoes) {
  const auto grid = some_grid<openvdb::FloatGrid>(0.5f);
  expect_same_bytes<openvdb::FloatGrid>(grid);
  grid->setSaveFloatAsHalf(true);
  expect_same_bytes<openvdb::FloatGrid>(grid);
  expect_same_bytes<openvdb::Vec3SGrid>(some_grid<openvdb::Vec3SGrid>(openvdb::Vec3s(1.0f)));
  expect_same_bytes<openvdb::FloatGrid>(openvdb::FloatGrid::create(1.0f));
}

TEST(ParallelGrid, KeepsNameTransformAndMetadataAndOtherTypes) {
  const auto grid = some_grid<openvdb::FloatGrid>(0.0f);
  grid->setName("density");
  grid->insertMeta("number", openvdb::Int32Metadata(3));
  const auto parallel = parallel_grid(grid);
  EXPECT_EQ(static_cast<const openvdb::MetaMap&>(*parallel), static_cast<const openvdb::MetaMap&>(*grid));
  EXPECT_EQ(parallel->transform(), grid->transform());
  EXPECT_EQ(&parallel->constBaseTree(), &grid->constBaseTree());
  const openvdb::GridBase::ConstPtr other = openvdb::Int32Grid::create(1);
  EXPECT_EQ(parallel_grid(other), other);
}

}  // namespace
}  // namespace solidnoise::parallel_grid_test
