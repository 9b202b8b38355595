// Noise with parameters from grids: variance, covariance, and that values depend on nothing but the place.
#include "solidnoise/field/varying_field.h"

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/field/combined_field.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/gabor/varying_gabor_noise.h"
#include "solidnoise/volume/parameters/parameter_fields.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/topology/volume_part.h"
#include "support/independent_values.h"
#include "support/parameter_grids.h"

namespace solidnoise::varying_field_test {
namespace {

using openvdb::CoordBBox;
using openvdb::FloatGrid;

ParameterGrid grid_in(const std::string& file, const std::string& name) {
  ParameterGrid grid;
  grid.source = {file, name};
  return grid;
}

KernelFields kernel_of(const ParameterGrids& grids) {
  return ParameterFields(grids).kernel();
}

std::shared_ptr<const ParameterFields> read(const ParameterGrids& grids) {
  return std::make_shared<ParameterFields>(grids);
}

NoiseRecipe recipe_of(double frequency, int octaves = 1) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = frequency, .impulses = 24.0, .seed = 5};
  recipe.fractal.octaves = octaves;
  return recipe;
}

NoiseRecipe oriented_recipe(double anisotropy) {
  NoiseRecipe recipe;
  recipe.noise =
      OrientedGaborNoiseOptions{.frequency = 3.0, .impulses = 24.0, .anisotropy = anisotropy, .seed = 5};
  return recipe;
}

// Grids whose frequency doubles twice along x, from 1 to 4, in eight bands, and whose bandwidth goes up and
// down along y. Their voxels are no cubes.
class Bands : public testing::Test {
 protected:
  static constexpr int kBands = 8;
  static constexpr double kBandWidth = 8.0;  // world units, two voxels

  Bands() {
    write_vdb(file_,
              {stretched("frequency", [](int i, int) { return frequency_of(i / 2); }),
               stretched("bandwidth", [](int, int j) { return 1.0 + 0.4 * std::sin(1.7 * j); })},
              {});
  }

  static double frequency_of(int band) { return std::exp2(2.0 * band / (kBands - 1)); }

  template <typename At>
  static FloatGrid::Ptr stretched(const std::string& name, const At& at) {
    const auto grid = FloatGrid::create();
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5 * kBandWidth));
    grid->transform().preScale(openvdb::Vec3d(1.0, 10.0, 10.0));
    auto accessor = grid->getAccessor();
    for (auto voxel = CoordBBox({0, -8, -8}, {2 * kBands - 1, 8, 8}).begin(); voxel; ++voxel) {
      accessor.setValue(*voxel, static_cast<float>(at((*voxel).x(), (*voxel).y())));
    }
    return grid;
  }

  // So far from each other that no two see the same impulse, between the two voxels of a band, which are
  // alike.
  static std::vector<Vec<3>> places(int band, double distance, int side) {
    std::vector<Vec<3>> result;
    for (int i = 0; i < side * side; ++i) {
      result.emplace_back((band + 0.25) * kBandWidth, (i % side - side / 2) * distance,
                          (i / side - side / 2) * distance);
    }
    return result;
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("bands.vdb");
};

// From the lowest frequency of the widest kernel to its highest, times the range of the frequencies.
TEST_F(Bands, BandFollowsTheGridsOfBandwidthAndFrequency) {
  ParameterGrids grids;
  grids.bandwidth = grid_in(file_, "bandwidth");
  const auto wide_band = [&] {
    NoiseRecipe recipe = recipe_of(1.0);
    std::get<GaborNoiseOptions>(recipe.noise).bandwidth = kernel_of(grids).bandwidth.greatest;
    return make_noise<3>(recipe)->band();
  }();
  const auto band = make_varying_field(recipe_of(1.0), {}, kernel_of(grids))->statistics()->band;
  EXPECT_DOUBLE_EQ(band.lower, wide_band.lower);
  EXPECT_DOUBLE_EQ(band.upper, wide_band.upper);
  EXPECT_GT(band.upper, make_noise<3>(recipe_of(1.0))->band().upper);  // of bandwidth 1
  grids.frequency = grid_in(file_, "frequency");
  const auto both = make_varying_field(recipe_of(1.0), {}, kernel_of(grids))->statistics()->band;
  EXPECT_NEAR(both.lower, wide_band.lower * frequency_of(0), 1e-6);
  EXPECT_NEAR(both.upper, wide_band.upper * frequency_of(kBands - 1), 1e-6 * both.upper);
}

// Eight bands, three noises, 4 sigma each: 24 times 6e-5 of false alarms.
TEST_F(Bands, VarianceIsOneInEachBandOfFrequency) {
  ParameterGrids grids;
  grids.frequency = grid_in(file_, "frequency");
  grids.bandwidth = grid_in(file_, "bandwidth");
  const KernelFields fields = kernel_of(grids);
  NoiseView in_time;
  in_time.dims = 4;
  in_time.time = 0.4;
  const auto plain = make_varying_field(recipe_of(1.0), {}, fields);
  const auto octaves = make_varying_field(recipe_of(1.0, 3), {}, fields);
  const auto frame = make_varying_field(recipe_of(1.0), in_time, fields);
  for (const auto& field : {plain, octaves, frame}) EXPECT_DOUBLE_EQ(field->statistics()->variance, 1.0);
  for (int band = 0; band < kBands; ++band) {
    SCOPED_TRACE(testing::Message() << "band " << band);
    const auto measure = [&](const Field<3>& field, double reach, int side) {
      const std::vector<Vec<3>> positions = places(band, 2.05 * reach / frequency_of(band), side);
      std::vector<float> values(positions.size());
      field.evaluate({positions}, {values, {}});
      expect_within_4_sigma(estimate_mean(values, [](double x) { return x * x; }), 1.0);
    };
    // Kernels reach farthest where the bandwidth is least, 0.6 octaves.
    measure(*plain, VaryingGaborNoise<3>({}).radius(1.0, 0.6), 80);
    measure(*octaves, VaryingGaborNoise<3>({}).radius(1.0, 0.6), 60);
    measure(*frame, VaryingGaborNoise<4>({}).radius(1.0, 0.6), 50);
  }
}

void expect_same(const NoiseRecipe& recipe, const ParameterGrids& grids, const VaryingGaborOptions& options,
                 double frequency, double bandwidth) {
  std::vector<Vec<3>> positions;
  for (int i = 0; i < 300; ++i) {
    positions.emplace_back(0.015625 * i - 2.0, 0.0078125 * i, 0.5 - 0.00390625 * i);
  }
  std::vector<float> from_grids(positions.size());
  make_varying_field(recipe, {}, kernel_of(grids))->evaluate({positions}, {from_grids, {}});

  const std::vector<float> frequencies(positions.size(), static_cast<float>(frequency));
  const std::vector<float> bandwidths(positions.size(), static_cast<float>(bandwidth));
  VaryingParameters<3> parameters;
  parameters.frequency = frequencies;
  parameters.bandwidth = bandwidths;
  std::vector<float> constant(positions.size());
  VaryingGaborNoise<3>(with_truncation_share(options)).evaluate({positions}, parameters, {constant, {}});
  for (std::size_t i = 0; i < positions.size(); ++i) EXPECT_NEAR(from_grids[i], constant[i], 1e-5) << i;
}

// A grid that is the same everywhere gives the noise that has the parameter everywhere: variance and spectrum
// are then those that the tests of VaryingGaborNoise prove.
TEST_F(Bands, ConstantGridsAreTheConstantParameter) {
  const std::string file = folder_.file("constant.vdb");
  const auto constant = [](float value) { return [=](double, double, double) { return value; }; };
  write_vdb(
      file,
      {grid_of<FloatGrid>("f", 0.5, cube_of(-8, 8), constant(3.0f)),
       grid_of<FloatGrid>("b", 0.5, cube_of(-8, 8), constant(1.25f)),
       grid_of<openvdb::Vec3SGrid>("d", 0.5, cube_of(-8, 8),
                                   [](double, double, double) { return openvdb::Vec3s(0.6f, -0.8f, 0.0f); })},
      {});
  ParameterGrids grids;
  grids.frequency = grid_in(file, "f");
  grids.bandwidth = grid_in(file, "b");
  VaryingGaborOptions options;
  options.frequency = 7.0;  // that of the grid counts
  options.impulses = 24.0;
  options.seed = 5;
  expect_same(recipe_of(7.0), grids, options, 3.0, 1.25);

  grids.direction = GridFile{file, "d"};
  options.waves = GaborWaves::oriented;
  options.direction = {0.6, -0.8, 0.0, 0.0};
  expect_same(oriented_recipe(1.0), grids, options, 3.0, 1.25);
}

// Waves in all directions alike become isotropic kernels.
TEST_F(Bands, OrientedNoiseOfNoDirectionIsIsotropic) {
  ParameterGrids grids;
  grids.frequency = grid_in(file_, "frequency");
  const std::vector<Vec<3>> positions{{1.0, 2.0, 3.0}, {20.0, -3.0, 0.5}, {60.0, 1.0, 1.0}};
  std::vector<float> isotropic(3);
  std::vector<float> oriented(3);
  make_varying_field(recipe_of(3.0), {}, kernel_of(grids))->evaluate({positions}, {isotropic, {}});
  make_varying_field(oriented_recipe(0.0), {}, kernel_of(grids))->evaluate({positions}, {oriented, {}});
  EXPECT_EQ(isotropic, oriented);
}

class Painted : public testing::Test {
 protected:
  Painted() {
    write_painted_grids(file_);
    all_.frequency = grid_in(file_, "ramp");
    all_.bandwidth = grid_in(file_, "narrow");
    all_.magnitude = grid_in(file_, "paint");
    all_.direction = GridFile{file_, "turn"};
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("painted.vdb");
  ParameterGrids all_;
};

bool identical(const FloatGrid& a, const FloatGrid& b) {
  if (!a.tree().hasSameTopology(b.tree())) return false;
  for (auto value = a.cbeginValueOn(); value; ++value) {
    const float other = b.tree().getValue(value.getCoord());
    if (std::memcmp(&*value, &other, sizeof(float)) != 0) return false;
  }
  return true;
}

FloatGrid::Ptr fill(const Topology& topology, const Field<3>& field, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  return fill_grid(topology, field, Sparsity::keep).grid;
}

TEST_F(Painted, ValuesDependOnThePlaceOnly) {
  const auto fields = read(all_);
  const Topology topology = sphere_topology(GridFrame(0.031), Vec<3>(0.05), 0.9);
  for (const int dims : {3, 4}) {
    SCOPED_TRACE(testing::Message() << dims << " dimensions");
    NoiseView view;
    view.dims = dims;
    view.time = dims == 4 ? 0.7 : 0.0;
    view.offset = {0.3, -0.2, 0.1};
    NoiseRecipe recipe = oriented_recipe(1.0);
    recipe.fractal.octaves = 2;
    const FieldPtr field = combine(Layer::Combine::product,
                                   {make_varying_field(recipe, view, fields->kernel()), fields->magnitude()});
    const FloatGrid::Ptr whole = fill(topology, *field, 2);
    EXPECT_TRUE(identical(*whole, *fill(topology, *field, 1)));

    // Leaf by leaf, and voxel by voxel.
    const auto block = field->block(topology.frame.bounds(topology.voxel_bounds()));
    std::vector<float> values(512);
    int leaves = 0;
    for (auto leaf = whole->tree().cbeginLeaf(); leaf; ++leaf, ++leaves) {
      if (leaves % 7 != 0) continue;
      block->evaluate(topology.frame.lattice(leaf->getNodeBoundingBox()), {values, {}});
      for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
        ASSERT_EQ(*voxel, values[voxel.pos()]) << voxel.getCoord();
      }
      const openvdb::Coord first = leaf->cbeginValueOn().getCoord();
      float alone = 0.0f;
      block->evaluate(topology.frame.lattice({first, first}), {{&alone, 1}, {}});
      ASSERT_EQ(alone, whole->tree().getValue(first));
    }

    // Part by part.
    std::size_t voxels = 0;
    for (int shard = 1; shard <= 3; ++shard) {
      const VolumePart part{.shard = shard, .shards = 3};
      const FloatGrid::Ptr grid = fill(take_part(topology, part), *field, 2);
      for (auto value = grid->cbeginValueOn(); value; ++value, ++voxels) {
        ASSERT_EQ(*value, whole->tree().getValue(value.getCoord())) << value.getCoord();
      }
    }
    EXPECT_EQ(voxels, whole->activeVoxelCount());
  }
}

TEST_F(Painted, FrequenciesAreMappedByRatiosAndStayBeyond) {
  ParameterGrid paint = grid_in(file_, "paint");  // 1/2 + x / 3
  paint.map = ValueMap{0.25, 0.75, 1.0, 16.0};
  const ScalarField field(paint, "--frequency-grid", kFrequencyRange);
  const std::vector<Vec<3>> positions{{-1.2, 0.0, 0.0}, {0.0, 0.1, 0.2}, {0.375, 0.0, 0.0}, {1.2, 0.3, 0.0}};
  std::vector<float> values(positions.size());
  field.evaluate({positions}, {values, {}});
  const std::vector<float> expected{1.0f, 4.0f, 8.0f, 16.0f};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-5 * expected[i]);
  EXPECT_EQ(field.least(), 1.0f);
  EXPECT_EQ(field.greatest(), 16.0f);
}

TEST_F(Painted, MagnitudeMultipliesWhateverNoiseItIs) {
  ParameterGrids grids;
  grids.magnitude = grid_in(file_, "paint");
  grids.magnitude->map = ValueMap{0.0, 0.5, 3.0, 1.0};  // falls from 3 to 1 on the way to the middle
  const auto fields = read(grids);
  const FieldPtr noise = make_noise<3>(recipe_of(3.0));
  const FieldPtr magnified = combine(Layer::Combine::product, {noise, fields->magnitude()});
  const Topology topology = box_topology(GridFrame(0.05), {Vec<3>(-0.9), Vec<3>(0.9)});
  const FloatGrid::Ptr plain = fill(topology, *noise, 2);
  const FloatGrid::Ptr result = fill(topology, *magnified, 2);
  for (auto value = result->cbeginValueOn(); value; ++value) {
    const double x = result->indexToWorld(value.getCoord()).x();
    const double expected = 3.0 - 2.0 * std::min(1.0, 2.0 * (0.5 + x / 3.0));
    ASSERT_NEAR(*value, expected * plain->tree().getValue(value.getCoord()), 1e-5);
  }
}

// A vector and its opposite are the same direction, also between them.
TEST_F(Painted, DirectionsHaveNoSign) {
  const auto turn = [](double x, double y) {
    return openvdb::Vec3s(static_cast<float>(1.0 + 0.3 * x), static_cast<float>(0.4 * y), 0.2f);
  };
  const auto sign = [](double x, double y, double z) {
    return std::lround((x + y + z) / 0.25) % 2 == 0 ? 1.0f : -1.0f;
  };
  const std::string file = folder_.file("signs.vdb");
  write_vdb(file,
            {grid_of<openvdb::Vec3SGrid>("one", 0.25, cube_of(-6, 6),
                                         [&](double x, double y, double) { return turn(x, y); }),
             grid_of<openvdb::Vec3DGrid>(
                 "signs", 0.25, cube_of(-6, 6),
                 [&](double x, double y, double z) { return openvdb::Vec3d(sign(x, y, z) * turn(x, y)); })},
            {});
  std::vector<Vec<3>> positions;
  for (int i = 0; i < 500; ++i) positions.emplace_back(0.0137 * (i % 90) - 0.6, 0.0021 * i - 0.5, 0.3);
  std::array<std::vector<float>, 2> values{std::vector<float>(500), std::vector<float>(500)};
  for (const std::size_t i : {0u, 1u}) {
    ParameterGrids grids;
    grids.direction = GridFile{file, i == 0 ? "one" : "signs"};
    make_varying_field(oriented_recipe(1.0), {}, kernel_of(grids))->evaluate({positions}, {values[i], {}});
  }
  for (std::size_t i = 0; i < 500; ++i) EXPECT_NEAR(values[0][i], values[1][i], 2e-5) << i;
}

}  // namespace
}  // namespace solidnoise::varying_field_test
