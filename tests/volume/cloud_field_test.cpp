#include "solidnoise/field/cloud_field.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/topology/fill.h"

namespace solidnoise::cloud_field_test {
namespace {

// The cumulus of the tool, coarser.
VolumeRecipe cumulus(std::uint64_t seed = 0) {
  VolumeRecipe recipe;
  recipe.noise.noise =
      OrientedGaborNoiseOptions{.frequency = 2.8, .error = 0.05, .impulses = 20, .seed = seed};
  recipe.noise.fractal = {.octaves = 3, .lacunarity = 2.1, .gain = 0.48};
  recipe.shaping = CloudShaping{.edge = 0.11, .wisps = 1.0};
  recipe.density.optical_depth = 85.0;
  recipe.box = {{-1.0, 0.0, -0.8}, {1.0, 1.15, 0.8}};
  recipe.dim = 72;
  return recipe;
}

openvdb::FloatGrid::Ptr make(const VolumeRecipe& recipe) {
  const Volume volume = make_volume(recipe, plan_volume(recipe), "test");
  return openvdb::gridPtrCast<openvdb::FloatGrid>(volume.grids.front().grid);
}

bool equal(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  if (a.activeVoxelCount() != b.activeVoxelCount()) return false;
  auto other = b.getConstAccessor();
  for (auto voxel = a.cbeginValueOn(); voxel; ++voxel) {
    if (other.getValue(voxel.getCoord()) != *voxel) return false;
  }
  return true;
}

FieldPtr field_of(const VolumeRecipe& recipe, double voxel) {
  CloudParts parts;
  parts.voxel = Vec<3>(voxel);
  parts.shaping = std::get<CloudShaping>(recipe.shaping);
  parts.wavelength = 1.0 / 2.8;
  parts.box = recipe.box;
  for (int k = 0; k < recipe.noise.fractal.octaves; ++k) {
    parts.octaves.push_back({FieldPtr(make_noise<3>(octave_of(recipe.noise, k))), std::pow(0.48, k)});
  }
  return make_cloud_field(parts);
}

TEST(CloudField, DensityIsFromZeroToOne) {
  const auto field = field_of(cumulus(), 0.03);
  const Topology box = box_topology(GridFrame(0.03), cumulus().box);
  const FilledGrid filled = fill_grid(box, *field, Sparsity::keep);
  EXPECT_EQ(filled.moments.min(), 0.0);
  EXPECT_LE(filled.moments.max(), 1.0);
  EXPECT_GT(filled.moments.max(), 0.99);  // its core is thicker than what core and edge need
}

TEST(CloudField, IsEmptyOnlyWhereItIsZero) {
  const auto field = field_of(cumulus(), 0.02);
  const Topology box = box_topology(GridFrame(0.02), {{-1.4, -0.4, -1.2}, {1.4, 1.6, 1.2}});
  int empty = 0;
  int full = 0;
  for (auto leaf = box.mask->cbeginLeaf(); leaf; ++leaf) {
    const openvdb::CoordBBox voxels = leaf->getNodeBoundingBox();
    if (!field->empty(box.frame.bounds(voxels))) {
      ++full;
      continue;
    }
    ++empty;
    std::vector<float> values(512);
    field->block(box.frame.bounds(voxels))->evaluate(box.frame.lattice(voxels), {values, {}});
    EXPECT_EQ(std::count(values.begin(), values.end(), 0.0f), 512);
  }
  EXPECT_GT(empty, full / 2);  // it is no use if it never says so
}

// A leaf by itself has another choice of puffs, impulses and octaves than the same leaf in a large block.
TEST(CloudField, DoesNotDependOnTheBlock) {
  const auto field = field_of(cumulus(), 0.02);
  const GridFrame frame(0.02);
  const auto whole = field->block({{-1.0, 0.0, -0.8}, {1.0, 1.15, 0.8}});
  int differ = 0;
  for (int i = -48; i < 48; i += 8) {
    for (int j = 0; j < 48; j += 8) {
      const openvdb::CoordBBox voxels({i, j, 0}, {i + 7, j + 7, 7});
      std::vector<float> alone(512);
      std::vector<float> together(512);
      field->block(frame.bounds(voxels))->evaluate(frame.lattice(voxels), {alone, {}});
      whole->evaluate(frame.lattice(voxels), {together, {}});
      differ += alone != together;
    }
  }
  EXPECT_EQ(differ, 0);
}

TEST(CloudVolume, IsTheSameForAnyNumberOfThreads) {
  const auto many = make(cumulus());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(equal(*many, *make(cumulus())));
}

TEST(CloudVolume, HasTheOpticalDepthThatIsAskedFor) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    VolumeRecipe recipe = cumulus();
    recipe.up = up;
    if (up == UpAxis::z) recipe.box = {{-1.0, -0.8, 0.0}, {1.0, 0.8, 1.15}};
    const double depth = thickest_column(*make(recipe), up == UpAxis::y ? 1 : 2);
    EXPECT_NEAR(depth, 85.0, 85.0 * 1e-5);  // densities are floats: 6e-8 each, and the sum of some 40
  }
}

TEST(CloudVolume, StandsUprightWithEitherAxisUp) {
  VolumeRecipe z_up = cumulus();
  z_up.up = UpAxis::z;
  z_up.box = {{-1.0, -0.8, 0.0}, {1.0, 0.8, 1.15}};
  // Its foot is wider than its top.
  const auto grid = make(z_up);
  const openvdb::CoordBBox bounds = grid->evalActiveVoxelBoundingBox();
  const int middle = (bounds.min().z() + bounds.max().z()) / 2;
  std::uint64_t below = 0;
  std::uint64_t above = 0;
  for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) ++(voxel.getCoord().z() < middle ? below : above);
  EXPECT_GT(below, 2 * above);  // it is 3 times; upside down it would be a third
}

// Of the pairs of neighbours of which at least one is in a cloud: those of which one is outside, and those
// whose densities differ by more than half of the largest.
struct Faces {
  int surface = 0;
  int steps = 0;
};

Faces faces_of(const openvdb::FloatGrid& grid) {
  float peak = 0.0f;
  for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) peak = std::max(peak, *voxel);
  Faces faces;
  auto values = grid.getConstAccessor();
  for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
    if (*voxel <= 0.0f) continue;
    for (int side = 0; side < 6; ++side) {
      openvdb::Coord beside = voxel.getCoord();
      beside[side / 2] += side % 2 == 0 ? -1 : 1;
      const float other = values.getValue(beside);
      if (other > 0.0f && side % 2 == 0) continue;  // seen from the other one
      faces.surface += other <= 0.0f;
      faces.steps += std::abs(other - *voxel) > 0.5f * peak;
    }
  }
  return faces;
}

// Lobes of four octaves are steep: with an edge of the width that the recipe says, whatever the voxels, it
// was 15 % of the faces at 256 voxels, and 22 % at 160.
TEST(CloudVolume, HasHardlyAnyStepsFromVoxelToVoxel) {
  VolumeRecipe recipe = cumulus();
  recipe.noise.fractal.octaves = 4;
  for (const int dim : {128, 256}) {
    recipe.dim = dim;
    const Faces faces = faces_of(*make(recipe));
    EXPECT_GT(faces.surface, 10000);
    EXPECT_LT(faces.steps, 0.02 * faces.surface)
        << dim << " voxels: " << faces.steps << " of " << faces.surface;
  }
}

// The tent keeps the mass; what is left is of interpolating between samples.
TEST(CloudVolume, HasTheSameMassOnAnyVoxels) {
  VolumeRecipe recipe = cumulus();
  recipe.noise.fractal.octaves = 4;
  const auto mass = [&](int dim) {
    recipe.dim = dim;
    const auto grid = make(recipe);
    double sum = 0.0;
    for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) sum += *voxel;
    return sum * std::pow(grid->voxelSize().x(), 3);
  };
  const double fine = mass(256);
  for (const int dim : {128, 192}) EXPECT_NEAR(mass(dim), fine, 0.005 * fine) << dim << " voxels";
}

TEST(CloudVolume, SeedsDiffer) {
  std::set<std::uint64_t> counts;  // equal ones could only be of equal shapes
  for (std::uint64_t seed = 0; seed < 5; ++seed) counts.insert(make(cumulus(seed))->activeVoxelCount());
  EXPECT_EQ(counts.size(), 5u);
}

// The lowest voxel of half the largest density, column by column, over the inner part of the cloud.
TEST(CloudVolume, HasAFlatterBaseThanTop) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto grid = make(cumulus(seed));
    const openvdb::CoordBBox bounds = grid->evalActiveVoxelBoundingBox();
    auto values = grid->getConstAccessor();
    float largest = 0.0f;
    for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) largest = std::max(largest, *voxel);
    std::vector<double> bottoms;
    std::vector<double> tops;
    for (int x = bounds.min().x(); x <= bounds.max().x(); ++x) {
      for (int z = bounds.min().z(); z <= bounds.max().z(); ++z) {
        int bottom = bounds.max().y() + 1;
        int top = bounds.min().y() - 1;
        for (int y = bounds.min().y(); y <= bounds.max().y(); ++y) {
          if (values.getValue({x, y, z}) < 0.5f * largest) continue;
          bottom = std::min(bottom, y);
          top = y;
        }
        if (top - bottom < 8) continue;  // the rim
        bottoms.push_back(bottom);
        tops.push_back(top);
      }
    }
    const auto spread = [](std::vector<double> v) {  // between the 1st and the 9th tenth
      std::sort(v.begin(), v.end());
      return v[v.size() * 9 / 10] - v[v.size() / 10];
    };
    ASSERT_GT(bottoms.size(), 500u);
    // Seeds 0 to 19 have 0.11 to 0.23 (base's 2 to 3 voxels); a pile of whole balls would have about 1.
    EXPECT_LT(spread(bottoms), 0.3 * spread(tops)) << "seed " << seed;
  }
}

TEST(CloudVolume, ChangesWithTime) {
  VolumeRecipe recipe = cumulus();
  recipe.dims = 4;
  recipe.dim = 40;
  const auto first = make(recipe);
  recipe.time = 0.05;
  const auto second = make(recipe);
  EXPECT_FALSE(equal(*first, *second));
  // The puffs stay: only lobes move, and on the mean over the surface they gain what they lose. Other puffs
  // (another seed) change the count by a fifth and more.
  const double change =
      static_cast<double>(second->activeVoxelCount()) / static_cast<double>(first->activeVoxelCount());
  EXPECT_NEAR(change, 1.0, 0.05);
}

TEST(CloudShaping, RefusesWhatMakesNoCloud) {
  EXPECT_THROW(CloudShaping{.puffs = 0}.validate(), std::invalid_argument);
  EXPECT_THROW(CloudShaping{.lobes = -0.1}.validate(), std::invalid_argument);
  EXPECT_THROW(CloudShaping{.base = 1.1}.validate(), std::invalid_argument);
  EXPECT_THROW(CloudShaping{.edge = 0.0}.validate(), std::invalid_argument);
  EXPECT_THROW(CloudShaping{.wisps = NAN}.validate(), std::invalid_argument);
  EXPECT_THROW(CloudShaping{.core = 2.0}.validate(), std::invalid_argument);
  EXPECT_THROW(CloudShaping{.lean = 3.0}.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::cloud_field_test
