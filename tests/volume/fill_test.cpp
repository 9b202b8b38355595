#include "solidnoise/volume/topology/fill.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/wave_field.h"

namespace solidnoise::fill_test {
namespace {

using openvdb::Coord;

const Vec<3> kFrequency(1.3, -0.7, 0.45);

WaveField wave() {
  return WaveField(kFrequency);
}

// Whether two grids have the same active voxels, the same leaves and the same bits in all of them.
bool identical(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  if (!a.tree().hasSameTopology(b.tree())) return false;
  auto other = b.tree().cbeginLeaf();
  for (auto leaf = a.tree().cbeginLeaf(); leaf; ++leaf, ++other) {
    if (leaf->origin() != other->origin()) return false;
    if (std::memcmp(leaf->buffer().data(), other->buffer().data(), 512 * sizeof(float)) != 0) return false;
  }
  return true;
}

bool identical(const Moments& a, const Moments& b) {
  return a.count() == b.count() && a.min() == b.min() && a.max() == b.max() && a.mean() == b.mean() &&
         a.sigma() == b.sigma() && a.skewness() == b.skewness() && a.excess_kurtosis() == b.excess_kurtosis();
}

// The positive part of a field; certainly 0 where x < 0, and there it must not be asked.
class PositiveHalf final : public Field<3> {
 public:
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    EXPECT_GE(box.lower.x, -0.8);  // a block begins with a leaf that reaches past x = 0
    class Block final : public FieldBlock<3> {
     public:
      explicit Block(std::unique_ptr<FieldBlock<3>> inner) : inner_(std::move(inner)) {}
      void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
        inner_->evaluate(lattice, samples);
        const std::span<float> values = samples.values;
        for (std::size_t i = 0; i < values.size(); ++i) {
          const double x = lattice.coordinate(0, static_cast<std::int64_t>(i) / 64);
          values[i] = x < 0.0 || values[i] < 0.0f ? 0.0f : values[i];
        }
      }

     private:
      std::unique_ptr<FieldBlock<3>> inner_;
    };
    return std::make_unique<Block>(wave_.block(box));
  }

  void evaluate(const Points<3>&, const Samples<3>&) const override { FAIL() << "grids are lattices"; }
  bool empty(const Box<3>& box) const override { return box.upper.x < 0.0; }

 private:
  WaveField wave_ = wave();
};

// Four waves as the channels of one field, each the positive part of a wave.
class FourWaves final : public PointwiseField {
 public:
  int channels() const override { return 4; }

  float at(int channel, const Vec<3>& p) const { return std::max(0.0f, waves_[channel].at(p)); }

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    ASSERT_EQ(samples.values.size(), 4 * points.size());
    for (std::size_t i = 0; i < samples.values.size(); ++i) {
      samples.values[i] = at(static_cast<int>(i / points.size()), points.positions[i % points.size()]);
    }
  }

 private:
  std::array<WaveField, 4> waves_{WaveField(kFrequency), WaveField({1, 0, 0}), WaveField({0, 1, 0}),
                                  WaveField({0.3, 0.2, 0.1})};
};

class Counter final : public Progress {
 public:
  explicit Counter(std::uint64_t stop_at = ~std::uint64_t{0}) : stop_at_(stop_at) {}

  void advance(std::uint64_t done, std::uint64_t total) override {
    const std::lock_guard lock(mutex_);
    most_done_ = std::max(most_done_, done);
    total_ = total;
  }
  bool cancelled() override {
    const std::lock_guard lock(mutex_);
    return most_done_ >= stop_at_;
  }

  std::uint64_t most_done() const { return most_done_; }
  std::uint64_t total() const { return total_; }

 private:
  std::mutex mutex_;
  std::uint64_t stop_at_;
  std::uint64_t most_done_ = 0;
  std::uint64_t total_ = 0;
};

TEST(FillGrid, GivesEachVoxelTheFieldsValueAtItsCentre) {
  const GridFrame frame(0.1);
  const FilledGrid filled =
      fill_grid(box_topology(frame, {{-1, -2, 0}, {1, 0.5, 1.7}}), wave(), Sparsity::keep);
  const WaveField field = wave();
  for (auto value = filled.grid->cbeginValueOn(); value; ++value) {
    const openvdb::Vec3d p = filled.grid->indexToWorld(value.getCoord());
    EXPECT_EQ(*value, field.at({p.x(), p.y(), p.z()}));
  }
  EXPECT_EQ(filled.grid->activeVoxelCount(), 20u * 25u * 17u);
  EXPECT_EQ(filled.grid->background(), 0.0f);
}

TEST(FillGrid, IsTheSameToTheBitForAnyNumberOfThreads) {
  const Topology topology = sphere_topology(GridFrame(0.05), {0.3, 0.1, -0.2}, 2.0);
  const auto fill_with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return fill_grid(topology, PositiveHalf(), Sparsity::drop);
  };
  const FilledGrid one = fill_with(1);
  ASSERT_GT(one.moments.count(), 10000u);
  for (const std::size_t threads : {2, 3, 8}) {
    const FilledGrid many = fill_with(threads);
    EXPECT_TRUE(identical(*one.grid, *many.grid)) << threads;
    EXPECT_TRUE(identical(one.moments, many.moments)) << threads;
  }
}

TEST(FillGrid, OfABoxCutInTwoAndJoinedIsTheSameToTheBit) {
  const GridFrame frame(0.1);
  const FilledGrid whole = fill_grid(box_topology(frame, {{-3, -1, -1}, {3, 1, 1}}), wave(), Sparsity::keep);
  const FilledGrid left = fill_grid(box_topology(frame, {{-3, -1, -1}, {0.3, 1, 1}}), wave(), Sparsity::keep);
  const FilledGrid right = fill_grid(box_topology(frame, {{0.3, -1, -1}, {3, 1, 1}}), wave(), Sparsity::keep);
  EXPECT_EQ(left.moments.count() + right.moments.count(), whole.moments.count());
  for (auto value = right.grid->cbeginValueOn(); value; ++value) {
    left.grid->tree().setValueOn(value.getCoord(), *value);
  }
  EXPECT_TRUE(identical(*whole.grid, *left.grid));
}

TEST(FillGrid, GivesAVoxelTheSameValueInEveryTopology) {
  const GridFrame frame(0.1);
  const FilledGrid box = fill_grid(box_topology(frame, {{-3, -3, -3}, {3, 3, 3}}), wave(), Sparsity::keep);
  const FilledGrid ball = fill_grid(sphere_topology(frame, Vec<3>(0.5), 1.5), wave(), Sparsity::keep);
  for (auto value = ball.grid->cbeginValueOn(); value; ++value) {
    EXPECT_EQ(*value, box.grid->tree().getValue(value.getCoord()));
  }
}

TEST(FillGrid, KeepsOrDropsVoxelsThatAreZero) {
  const GridFrame frame(0.1);
  const Topology topology = box_topology(frame, {{-3.2, -1.6, -1.6}, {3.2, 1.6, 1.6}});
  const FilledGrid kept = fill_grid(topology, PositiveHalf(), Sparsity::keep);
  EXPECT_EQ(kept.moments.count(), topology.voxel_count());
  EXPECT_EQ(kept.grid->tree().leafCount(), topology.leaf_count());
  EXPECT_EQ(kept.grid->tree().getValue(Coord(-30, 0, 0)), 0.0f);

  const FilledGrid dropped = fill_grid(topology, PositiveHalf(), Sparsity::drop);
  EXPECT_EQ(dropped.grid->tree().leafCount(), topology.leaf_count() / 2);
  std::uint64_t positive = 0;
  for (auto value = kept.grid->cbeginValueOn(); value; ++value) positive += *value > 0.0f;
  EXPECT_EQ(dropped.grid->activeVoxelCount(), positive);
  EXPECT_GT(dropped.moments.min(), 0.0);
  for (auto value = dropped.grid->cbeginValueOff(); value; ++value) EXPECT_EQ(*value, 0.0f);
}

TEST(FillGrid, GathersTheMomentsThatMeasureFinds) {
  const FilledGrid filled =
      fill_grid(sphere_topology(GridFrame(0.07), Vec<3>(0.0), 2.0), PositiveHalf(), Sparsity::drop);
  EXPECT_TRUE(identical(filled.moments, measure(*filled.grid)));
}

TEST(FillGrid, ReportsProgressUpToTheNumberOfLeaves) {
  Counter counter;
  const Topology topology = box_topology(GridFrame(0.1), {{-3, -3, -3}, {3, 3, 3}});
  fill_grid(topology, wave(), Sparsity::keep, &counter);
  EXPECT_EQ(counter.total(), topology.leaf_count());
  EXPECT_EQ(counter.most_done(), topology.leaf_count());
}

TEST(FillGrid, StopsSoonAfterItIsAskedTo) {
  Counter counter(64);
  const Topology topology = box_topology(GridFrame(0.05), {{-3, -3, -3}, {3, 3, 3}});
  EXPECT_THROW(fill_grid(topology, wave(), Sparsity::keep, &counter), Cancelled);
  EXPECT_LT(counter.most_done(), topology.leaf_count() / 2);
}

TEST(FillGrid, LetsTheFieldsExceptionThrough) {
  class Failing final : public PointwiseField {
    void evaluate(const Points<3>&, const Samples<3>&) const override { throw std::runtime_error("no"); }
  };
  const Topology topology = box_topology(GridFrame(0.1), {{-3, -3, -3}, {3, 3, 3}});
  EXPECT_THROW(fill_grid(topology, Failing(), Sparsity::keep), std::runtime_error);
}

TEST(FillGrids, GivesEachGridItsChannelsAndTheirMoments) {
  const Topology topology = sphere_topology(GridFrame(0.1), {0.3, 0.1, -0.2}, 1.0);
  const FourWaves field;
  const auto filled = fill_grids(topology, field, {{0, 1}, {1, 3}});
  ASSERT_EQ(filled.size(), 2u);
  const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(filled[0].grid);
  const auto vectors = openvdb::gridPtrCast<openvdb::Vec3SGrid>(filled[1].grid);
  ASSERT_TRUE(floats && vectors);
  EXPECT_EQ(floats->activeVoxelCount(), topology.voxel_count());
  EXPECT_EQ(vectors->activeVoxelCount(), topology.voxel_count());
  EXPECT_EQ(vectors->background(), openvdb::Vec3s(0.0f));
  for (auto voxel = vectors->cbeginValueOn(); voxel; ++voxel) {
    const openvdb::Vec3d p = vectors->indexToWorld(voxel.getCoord());
    EXPECT_EQ(floats->tree().getValue(voxel.getCoord()), field.at(0, {p.x(), p.y(), p.z()}));
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ((*voxel)[axis], field.at(1 + axis, {p.x(), p.y(), p.z()}));
  }
  EXPECT_TRUE(identical(filled[0].moments.at(0), measure(*floats)));
  const std::array<Moments, 3> measured = measure(*vectors);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(identical(filled[1].moments.at(axis), measured[axis])) << axis;
  }
}

TEST(FillGrids, DropsAVectorOnlyWhereAllOfItIsZero) {
  const Topology topology = box_topology(GridFrame(0.1), {{-1, -1, -1}, {1, 1, 1}});
  const FourWaves field;
  const auto filled = fill_grids(topology, field, {{0, 3, Sparsity::drop}, {3, 1, Sparsity::drop}});
  std::uint64_t vectors = 0;
  std::uint64_t floats = 0;
  for (auto voxel = openvdb::CoordBBox::createCube(openvdb::Coord(-10), 20).begin(); voxel; ++voxel) {
    const openvdb::Vec3d p = filled[0].grid->indexToWorld(*voxel);
    const auto positive = [&](int channel) { return field.at(channel, {p.x(), p.y(), p.z()}) > 0.0f; };
    vectors += positive(0) || positive(1) || positive(2);
    floats += positive(3);
  }
  EXPECT_EQ(filled[0].grid->activeVoxelCount(), vectors);
  EXPECT_EQ(filled[1].grid->activeVoxelCount(), floats);
  EXPECT_LT(vectors, topology.voxel_count());
  EXPECT_LT(floats, vectors);
}

TEST(FillGrids, RefusesGridsThatDoNotFitTheField) {
  const Topology topology = box_topology(GridFrame(0.1), {{-1, -1, -1}, {1, 1, 1}});
  for (const GridChannels& channels : {GridChannels{4, 1}, {2, 3}, {-1, 1}, {0, 2}}) {
    EXPECT_THROW(fill_grids(topology, FourWaves(), {channels}), std::invalid_argument) << channels.first;
  }
  EXPECT_THROW(fill_grid(topology, FourWaves(), Sparsity::keep), std::invalid_argument);
}

TEST(ScaleValues, MultipliesLeavesAndTilesAndKeepsTheTopology) {
  FilledGrid filled = fill_grid(box_topology(GridFrame(0.1), {{0, 0, 0}, {1, 1, 1}}), wave(), Sparsity::keep);
  filled.grid->tree().addTile(1, Coord(64), 3.0f, true);
  const float before = filled.grid->tree().getValue(Coord(4));
  const std::uint64_t active = filled.grid->activeVoxelCount();
  scale_values(*filled.grid, 0.5f);
  EXPECT_EQ(filled.grid->tree().getValue(Coord(4)), 0.5f * before);
  EXPECT_EQ(filled.grid->tree().getValue(Coord(65)), 1.5f);
  EXPECT_EQ(filled.grid->tree().getValue(Coord(1000)), 0.0f);
  EXPECT_EQ(filled.grid->activeVoxelCount(), active);
}

}  // namespace
}  // namespace solidnoise::fill_test
