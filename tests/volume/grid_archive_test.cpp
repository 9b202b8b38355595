#include "solidnoise/volume/vdb/grid_archive.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/File.h>

#include "support/temporary_folder.h"

namespace solidnoise::grid_archive_test {
namespace {

// Two grids of one name, one that shares the tree of the first, one of half floats that shares it too and so
// cannot share it in the file, and one of another type.
openvdb::GridCPtrVec some_grids() {
  openvdb::initialize();
  const auto first = openvdb::FloatGrid::create(0.0f);
  auto accessor = first->getAccessor();
  const openvdb::CoordBBox box(openvdb::Coord(-9), openvdb::Coord(20));
  int count = 0;
  for (auto voxel = box.begin(); voxel; ++voxel) accessor.setValue(*voxel, 0.001f * float(++count % 1009));
  first->setName("density");
  first->insertMeta("number", openvdb::Int32Metadata(3));
  const auto sharing = first->copy();
  sharing->setName("sharing");
  const auto half = first->copy();
  half->setName("half");
  half->setSaveFloatAsHalf(true);
  const auto second = first->deepCopy();
  const auto mask = openvdb::MaskGrid::create();
  mask->tree().setValueOn(openvdb::Coord(1));
  mask->setName("mask");
  return {first, sharing, half, second, mask};
}

constexpr std::uint32_t kCompression = openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC;

// All grids of a file, as OpenVDB reads them.
openvdb::GridPtrVec read(const std::string& path) {
  openvdb::io::File file(path);
  file.open(false);
  const openvdb::GridPtrVecPtr grids = file.getGrids();
  return *grids;
}

TEST(GridArchive, WritesWhatOpenvdbDoesButItsSizesForDelayedLoading) {
  const TemporaryFolder folder;
  const openvdb::GridCPtrVec grids = some_grids();
  const std::string theirs = folder / "theirs.vdb";
  const std::string ours = folder / "ours.vdb";
  openvdb::io::File file(theirs);
  file.setCompression(kCompression);
  file.write(grids);
  file.close();
  {
    std::ofstream stream(ours, std::ios::binary);
    GridArchive archive;
    archive.setCompression(kCompression);
    archive.write_grids(stream, GridArchive::Offsets::write, {grids, {}, [] { return 0; }});
  }

  const openvdb::GridPtrVec expected = read(theirs);
  const openvdb::GridPtrVec found = read(ours);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i]->getName(), expected[i]->getName());
    EXPECT_EQ(found[i]->type(), expected[i]->type());
    EXPECT_EQ(static_cast<const openvdb::MetaMap&>(*found[i]),
              static_cast<const openvdb::MetaMap&>(*expected[i]));
    EXPECT_EQ(found[i]->transform(), expected[i]->transform());
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(&found[i]->baseTree() == &found[j]->baseTree(),
                &expected[i]->baseTree() == &expected[j]->baseTree())
          << found[i]->getName() << ", " << found[j]->getName();
    }
    const auto values = openvdb::gridPtrCast<openvdb::FloatGrid>(found[i]);
    if (!values) continue;
    const auto& others = openvdb::gridPtrCast<openvdb::FloatGrid>(expected[i])->tree();
    ASSERT_TRUE(values->tree().hasSameTopology(others));
    for (auto value = values->cbeginValueAll(); value; ++value)
      ASSERT_EQ(*value, others.getValue(value.getCoord()));
  }

  const auto holds_sizes = [](const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    return bytes.find(openvdb::GridBase::META_FILE_DELAYED_LOAD) != std::string::npos;
  };
  EXPECT_FALSE(holds_sizes(ours));
}

TEST(GridArchive, FillsInTheOffsetsOfEachGrid) {
  const TemporaryFolder folder;
  const std::string path = folder / "ours.vdb";
  {
    std::ofstream stream(path, std::ios::binary);
    GridArchive().write_grids(stream, GridArchive::Offsets::write, {some_grids(), {}, [] { return 0; }});
  }
  openvdb::io::File file(path);
  file.open(false);
  const auto mask = openvdb::gridPtrCast<openvdb::MaskGrid>(file.readGrid("mask"));
  EXPECT_EQ(mask->activeVoxelCount(), 1u);
}

}  // namespace
}  // namespace solidnoise::grid_archive_test
