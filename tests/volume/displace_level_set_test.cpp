#include "solidnoise/volume/modify/displace_level_set.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/GridOperators.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <tbb/global_control.h>

#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/message_of.h"
#include "volume/wave_grid.h"

namespace solidnoise::displace_level_set_test {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3d;

// A product of waves, between -1 and 1.
class Waves final : public PointwiseField {
 public:
  explicit Waves(double frequency) : frequency_(frequency) {}

  double at(const Vec<3>& p) const {
    const double k = 2.0 * std::numbers::pi * frequency_;
    return std::sin(k * p.x) * std::sin(k * p.y + 1.0) * std::sin(k * p.z + 2.0);
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples.values[i] = static_cast<float>(at(points.positions[i]));
    }
  }

 private:
  double frequency_;
};

// The same everywhere but where x is negative, where it is 0.
class OneSide final : public PointwiseField {
 public:
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      samples.values[i] = points.positions[i].x > 0.0 ? 1.0f : 0.0f;
    }
  }
};

constexpr double kVoxel = 0.02;
constexpr double kRadius = 0.7;

FloatGrid::Ptr sphere(double half_width = 3.0) {
  auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(
      static_cast<float>(kRadius), openvdb::Vec3f(0.1f, 0.0f, -0.2f), static_cast<float>(kVoxel),
      static_cast<float>(half_width));
  grid->setName("ball");
  return grid;
}
const Vec3d kCentre(0.1f, 0.0f, -0.2f);

// Directions that cover the sphere evenly (a golden spiral).
std::vector<Vec3d> directions(int count) {
  std::vector<Vec3d> result;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count;
    const double r = std::sqrt(1.0 - z * z);
    result.emplace_back(r * std::cos(i * turn), r * std::sin(i * turn), z);
  }
  return result;
}

// Where the grid changes its sign on a ray, within two voxels of the expected distance; NaN if nowhere.
double zero_on_ray(const FloatGrid& grid, const Vec3d& direction, double expected) {
  const auto values = grid.getConstAccessor();
  const auto at = [&](double distance) {
    return openvdb::tools::BoxSampler::sample(values, grid.worldToIndex(kCentre + distance * direction));
  };
  double inside = expected - 2.0 * kVoxel;
  double outside = expected + 2.0 * kVoxel;
  if (!(at(inside) < 0.0f && at(outside) > 0.0f)) return std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (at(middle) < 0.0f ? inside : outside) = middle;
  }
  return inside;
}

// All of OpenVDB's checks of a level set, |gradient| = 1 to its own tolerance included.
std::string diagnosis(const FloatGrid& grid) {
  return openvdb::tools::CheckLevelSet<FloatGrid>(grid).check(9);
}

std::size_t parts_of(const FloatGrid& grid) {
  std::vector<FloatGrid::Ptr> parts;
  openvdb::tools::segmentSDF(grid, parts);
  return parts.size();
}

double mean_error_of_gradient(const FloatGrid& grid) {
  const auto gradient = openvdb::tools::gradient(grid);
  double sum = 0.0;
  double count = 0.0;
  for (auto value = grid.cbeginValueOn(); value; ++value) {
    if (std::abs(*value) > 2.0 * kVoxel) continue;  // the outermost differences look past the band
    sum += std::abs(gradient->tree().getValue(value.getCoord()).length() - 1.0f);
    count += 1.0;
  }
  return sum / count;
}

// Trilinear interpolation errs by up to 1/8 of the sum of second derivatives along the axes, per voxel: that
// of a distance is the sum of the curvatures, 2 / R for a ball of R voxels.
double interpolation_error(double curvatures) {
  return curvatures / 8.0;
}
constexpr double kVoxelRadius = kRadius / kVoxel;

// Closest points are found on the interpolated surface, of the ball and of what became of it, where the test
// looks for zeros in the same way. Waves of amplitude A add 2 A k^2 to the curvatures, k = 2 pi f per voxel;
// their root mean square is 1 / sqrt(8) of that.
TEST(DisplaceLevelSet, MovesTheSurfaceAlongItsNormalByTheNoise) {
  const Waves waves(1.25);
  for (const double amount : {2.5 * kVoxel, -2.5 * kVoxel, 5.0 * kVoxel}) {
    const auto moved = displace_level_set(*sphere(), waves, amount);
    double squares = 0.0;
    double worst = 0.0;
    const auto rays = directions(2000);
    for (const Vec3d& ray : rays) {
      const Vec3d point = kCentre + kRadius * ray;
      const double expected = kRadius + amount * waves.at({point.x(), point.y(), point.z()});
      const double error = (zero_on_ray(*moved, ray, expected) - expected) / kVoxel;
      squares += error * error;
      worst = std::max(worst, std::abs(error));
      ASSERT_TRUE(std::isfinite(error)) << "no surface where it should be";
    }
    const double k = 2.0 * std::numbers::pi * 1.25 * kVoxel;
    const double of_waves = 2.0 * std::abs(amount / kVoxel) * k * k;
    const double of_ball = 2.0 / kVoxelRadius;
    const auto bound = [&](double curvatures) {
      return interpolation_error(of_ball) + 2.0 * interpolation_error(of_ball + curvatures);
    };
    EXPECT_LT(worst, bound(of_waves)) << amount;  // voxels
    EXPECT_LT(std::sqrt(squares / 2000.0), bound(of_waves / std::sqrt(8.0))) << amount;
  }
}

TEST(DisplaceLevelSet, MakesADistanceFieldThatIsNotTorn) {
  const Waves waves(1.25);
  for (const double amount : {2.5 * kVoxel, -2.5 * kVoxel, 5.0 * kVoxel}) {
    const auto moved = displace_level_set(*sphere(), waves, amount);
    EXPECT_EQ(diagnosis(*moved), "") << amount;
    EXPECT_LT(mean_error_of_gradient(*moved), 0.02) << amount;
    EXPECT_EQ(parts_of(*moved), 1u) << amount;
    EXPECT_EQ(moved->getName(), "ball");
    EXPECT_EQ(moved->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_EQ(moved->transform(), sphere()->transform());
    EXPECT_EQ(moved->background(), sphere()->background());
  }
}

TEST(DisplaceLevelSet, WorksWithNoiseOfSeveralOctaves) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.5, .seed = 3};
  recipe.fractal.octaves = 3;
  const auto moved = displace_level_set(*sphere(), *make_noise<3>(recipe), kVoxel);
  EXPECT_EQ(diagnosis(*moved), "");
  EXPECT_EQ(parts_of(*moved), 1u);
}

// Growing a ball by a constant gives a larger ball; the distance is known everywhere. 20 voxels are far
// outside of the band of 3. Closest points on both balls are on interpolated surfaces, whose errors add; the
// rest is for points that are found to 0.05 voxels along the surface and for three steps of normalization,
// whose differences of fifth order see a kink at the end of the band.
TEST(DisplaceLevelSet, ReachesFarBeyondTheBand) {
  class Constant final : public PointwiseField {
    void evaluate(const Points<3>&, const Samples<3>& samples) const override {
      std::ranges::fill(samples.values, 1.0f);
    }
  };
  for (const double amount : {20.0 * kVoxel, -20.0 * kVoxel}) {
    const auto moved = displace_level_set(*sphere(), Constant(), amount);
    EXPECT_EQ(diagnosis(*moved), "") << amount;
    const double moved_radius = kVoxelRadius + amount / kVoxel;
    const double error = interpolation_error(2.0 / kVoxelRadius) + interpolation_error(2.0 / moved_radius);
    for (auto value = moved->cbeginValueOn(); value; ++value) {
      const double distance = (moved->indexToWorld(value.getCoord()) - kCentre).length() - kRadius - amount;
      ASSERT_NEAR(*value, distance, (error + 0.005) * kVoxel) << amount << value.getCoord();
    }
  }
}

TEST(DisplaceLevelSet, MovesEdgesAndFlatSidesOfACube) {
  const auto cube = openvdb::tools::createLevelSetCube<FloatGrid>(1.0f, openvdb::Vec3f(0), 0.025f);
  const Waves waves(1.0);
  for (const double amount : {0.1, -0.1}) {
    const auto moved = displace_level_set(*cube, waves, amount);
    EXPECT_EQ(parts_of(*moved), 1u);
    EXPECT_EQ(openvdb::tools::CheckLevelSet<FloatGrid>(*moved).check(8), "");
  }
}

TEST(DisplaceLevelSet, KeepsTheRestBitForBit) {
  const auto ball = sphere();
  const auto moved = displace_level_set(*ball, OneSide(), 2.0 * kVoxel);
  // What is further from where it moved than its way, the band and some voxels for the tools' stencils.
  const double border = -15.0 * kVoxel;
  int compared = 0;
  for (auto value = ball->cbeginValueOn(); value; ++value) {
    if (ball->indexToWorld(value.getCoord()).x() > border) continue;
    ASSERT_TRUE(moved->tree().isValueOn(value.getCoord()));
    ASSERT_EQ(moved->tree().getValue(value.getCoord()), *value);
    ++compared;
  }
  EXPECT_GT(compared, 10000);
  EXPECT_NEAR(zero_on_ray(*moved, Vec3d(1, 0, 0), kRadius + 2.0 * kVoxel), kRadius + 2.0 * kVoxel,
              0.05 * kVoxel);
  EXPECT_TRUE(same_values(*displace_level_set(*ball, OneSide(), 0.0), *ball));
}

TEST(DisplaceLevelSet, KeepsTheBandsWidthAndTakesTilesForOutsideOfIt) {
  const auto wide = displace_level_set(*sphere(5.0), Waves(1.25), kVoxel);
  EXPECT_FLOAT_EQ(wide->background(), static_cast<float>(5.0 * kVoxel));
  EXPECT_EQ(diagnosis(*wide), "");

  const auto tiled = sphere();
  tiled->tree().addTile(1, openvdb::Coord(0), -tiled->background(), true);
  EXPECT_TRUE(same_values(*displace_level_set(*tiled, Waves(1.25), kVoxel),
                          *displace_level_set(*sphere(), Waves(1.25), kVoxel)));
}

TEST(DisplaceLevelSet, IsTheSameForAnyNumberOfThreads) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 2.0};
  const auto noise = make_noise<3>(recipe);
  const auto moved = displace_level_set(*sphere(), *noise, 2.0 * kVoxel);
  const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(same_values(*displace_level_set(*sphere(), *noise, 2.0 * kVoxel), *moved));
}

// Counts what it is asked and told, and stops the work when it was asked so often.
class Watch final : public Progress {
 public:
  explicit Watch(int stop_at = std::numeric_limits<int>::max()) : stop_at_(stop_at) {}
  void advance(std::uint64_t done, std::uint64_t total) override {
    const double fraction = static_cast<double>(done) / static_cast<double>(total);
    EXPECT_LE(last_, fraction);
    EXPECT_LE(fraction, 1.0);
    if (fraction > last_) ++told_;
    last_ = fraction;
  }
  bool cancelled() override { return ++asked_ >= stop_at_; }

  int asked() const { return asked_; }
  int told() const { return told_; }

 private:
  int stop_at_;
  std::atomic<int> asked_{0};
  int told_ = 0;  // displace_level_set tells from one thread
  double last_ = 0.0;
};

// Each leaf of each layer asks: 30 leaves across the ball have 3000 on it.
TEST(DisplaceLevelSet, TellsHowFarItIsAndStopsAnywhere) {
  Watch whole;
  displace_level_set(*sphere(), Waves(1.25), 2.0 * kVoxel, &whole);
  EXPECT_GT(whole.told(), 10);
  EXPECT_GT(whole.asked(), 10000);
  for (int tenth = 1; tenth < 10; ++tenth) {
    Watch watch(whole.asked() / 10 * tenth);
    EXPECT_THROW(displace_level_set(*sphere(), Waves(1.25), 2.0 * kVoxel, &watch), Cancelled) << tenth;
  }
}

TEST(DisplaceLevelSet, StopsWhenAskedTo) {
  class Stop final : public Progress {
    void advance(std::uint64_t, std::uint64_t) override {}
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(displace_level_set(*sphere(), Waves(1.0), kVoxel, &stop), Cancelled);
}

TEST(DisplaceLevelSet, RefusesWhatIsNoLevelSet) {
  const auto refusal = [](const FloatGrid& grid, double amount) {
    return message_of<std::invalid_argument>([&] { displace_level_set(grid, Waves(1.0), amount); });
  };
  const auto fog = sphere();
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  EXPECT_NE(refusal(*fog, 0.1).find("class is not level set"), std::string::npos);
  const auto stretched = sphere();
  stretched->transform().preScale(Vec3d(1, 2, 1));
  EXPECT_NE(refusal(*stretched, 0.1).find("not cubes"), std::string::npos);
  EXPECT_NE(refusal(*sphere(), std::numeric_limits<double>::quiet_NaN()).find("displace"), std::string::npos);
}

// Noise of steep octaves, up to fourteen voxels high: seen from the centre the surface is a function of the
// direction, so that it is of one piece.
TEST(DisplaceLevelSet, SteepSpikesDoNotTear) {
  const auto ball = openvdb::tools::createLevelSetSphere<FloatGrid>(0.8f, openvdb::Vec3f(0.0f), 0.0125f);
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.5, .bandwidth = 1.5, .seed = 2};
  recipe.fractal = {.octaves = 4, .gain = 0.45};
  const auto noise = make_noise<3>(recipe);
  const auto moved = displace_level_set(*ball, *noise, 0.06);
  EXPECT_EQ(parts_of(*moved), 1u);
}

// What estimate_displaced_voxels() says, over what there are.
TEST(DisplaceLevelSet, EstimatesTheVoxelsOfTheMovedBand) {
  for (const double half_width : {3.0, 9.0}) {
    const FloatGrid::Ptr ball = sphere(half_width);
    for (const double frequency : {1.0, 6.0}) {
      NoiseRecipe recipe;
      recipe.noise = GaborNoiseOptions{.frequency = frequency};
      const auto noise = make_noise<3>(recipe);
      for (const double amount : {0.005, 0.03, 0.1}) {
        const FloatGrid::Ptr moved = displace_level_set(*ball, *noise, amount);
        const double ratio = estimate_displaced_voxels(*ball, amount, frequency) /
                             static_cast<double>(moved->activeVoxelCount());
        EXPECT_GT(ratio, 0.8) << half_width << " voxels, " << frequency << " by " << amount;
        EXPECT_LT(ratio, 1.7) << half_width << " voxels, " << frequency << " by " << amount;
      }
    }
  }
}

}  // namespace
}  // namespace solidnoise::displace_level_set_test
