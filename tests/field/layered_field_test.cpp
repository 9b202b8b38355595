#include "solidnoise/field/layered_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/special_functions.h"
#include "solidnoise/field/combined_field.h"
#include "solidnoise/field/moved_field.h"
#include "solidnoise/field/value_maps.h"
#include "solidnoise/noise/gabor/gabor_noise.h"
#include "support/independent_values.h"

namespace solidnoise::layered_field_test {
namespace {

using Fold = Layer::Fold;
using Histogram = Layer::Histogram;
using Combine = Layer::Combine;

// Of so many impulses that the values are all but Gaussian.
NoiseRecipe many_impulses(int octaves = 1) {
  NoiseRecipe recipe;
  recipe.noise = GaborNoiseOptions{.frequency = 1.0, .impulses = 400.0, .seed = 5};
  recipe.fractal.octaves = octaves;
  recipe.fractal.gain = 0.7;
  return recipe;
}

std::shared_ptr<const Noise<3>> make_plain(const NoiseRecipe& recipe) {
  return make_noise<3>(recipe);
}

FieldPtr make_field_of(const std::vector<Layer>& layers, const NoiseRecipe& own = many_impulses()) {
  return make_layered_field(layers, own, make_plain);
}

// Positions of which no two see the same impulse.
std::vector<Vec<3>> independent_positions(const NoiseRecipe& recipe) {
  const Lattice<3> lattice =
      independent_lattice<3>(GaborNoise<3>(std::get<GaborNoiseOptions>(recipe.noise)).radius());
  std::vector<Vec<3>> positions;
  for (std::size_t i = 0; i < lattice.size(); i += 2) positions.push_back(sample_position(lattice, i));
  return positions;
}

std::vector<float> values_at(const Field<3>& field, const std::vector<Vec<3>>& positions) {
  std::vector<float> values(positions.size());
  field.evaluate({positions}, {values, {}});
  return values;
}

std::vector<float> values_on(const Field<3>& field, const Lattice<3>& lattice) {
  std::vector<float> values(lattice.size());
  field.block(lattice.bounds())->evaluate(lattice, {values, {}});
  return values;
}

float value_at(const Noise<3>& noise, const Vec<3>& position) {
  std::array<float, 1> value{};
  noise.evaluate(Points<3>{{&position, 1}}, {value, {}});
  return value[0];
}

// Within 4 standard errors, and what an excess kurtosis k of the noise makes of it: by the next term of
// Edgeworth's series E |n| is smaller by k / 24 of it, which is 0.06 k of the standard deviation of |n|, and
// its variance larger by 0.15 k of it. k is 0.12.
TEST(LayeredField, FoldsHaveMeanZeroAndVarianceOne) {
  const double kurtosis = make_plain(many_impulses())->excess_kurtosis();
  ASSERT_LT(kurtosis, 0.12);
  for (const int octaves : {1, 3}) {
    const NoiseRecipe own = many_impulses(octaves);
    const std::vector<Vec<3>> positions = independent_positions(own);
    for (const Fold fold : {Fold::none, Fold::ridged, Fold::billow, Fold::turbulence}) {
      SCOPED_TRACE(testing::Message() << "fold " << static_cast<int>(fold) << ", octaves " << octaves);
      const std::vector<float> values = values_at(*make_field_of({{.fold = fold}}, own), positions);
      const Estimate mean = estimate_mean(values, [](double v) { return v; });
      const Estimate variance = estimate_mean(values, [](double v) { return v * v; });
      EXPECT_NEAR(mean.mean, 0.0, 4.0 * mean.error + 0.06 * kurtosis);
      EXPECT_NEAR(variance.mean, 1.0, 4.0 * variance.error + 0.15 * kurtosis);
    }
  }
}

TEST(LayeredField, RidgesAreTurbulenceUpsideDown) {
  const NoiseRecipe own = many_impulses(3);
  const Lattice<3> lattice{Vec<3>(0.3), Vec<3>(0.1), {-4, 0, 7}, {8, 8, 8}};
  const std::vector<float> ridged = values_on(*make_field_of({{.fold = Fold::ridged}}, own), lattice);
  const std::vector<float> turbulence = values_on(*make_field_of({{.fold = Fold::turbulence}}, own), lattice);
  for (std::size_t i = 0; i < ridged.size(); ++i) EXPECT_EQ(ridged[i], -turbulence[i]);
}

// Octave k of the noise, without the scale of their sum; the values are rounded to float at each step.
TEST(LayeredField, TurbulenceSumsTheOctavesOneByOne) {
  const NoiseRecipe own = many_impulses(3);
  const auto field = make_field_of({{.fold = Fold::turbulence}}, own);
  const FoldStatistics statistics = fold_statistics(Fold::turbulence, own.fractal);
  for (const Vec<3>& position : {Vec<3>(0.25, -1.5, 3.0), Vec<3>(7.0, 0.0, -0.125)}) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      sum += std::pow(0.7, k) * std::abs(value_at(*make_plain(octave_of(own, k)), position));
    }
    EXPECT_NEAR(values_at(*field, {position})[0], (sum - statistics.mean) / std::sqrt(statistics.variance),
                1e-5);
  }
}

// Chi-square over 64 bins: a false alarm in 100000 for each, were the noise Gaussian. Its excess kurtosis k
// adds N k^2 / 24 = 6 to a statistic of 63 +- 11, which makes it one in 10000.
TEST(LayeredField, UniformHistogramsAreUniform) {
  struct Case {
    Fold fold;
    int octaves;
  };
  for (const Case& of : {Case{Fold::none, 1}, Case{Fold::none, 3}, Case{Fold::billow, 3},
                         Case{Fold::ridged, 1}, Case{Fold::turbulence, 1}}) {
    const NoiseRecipe own = many_impulses(of.octaves);
    const auto field = make_field_of({{.fold = of.fold, .histogram = Histogram::uniform}}, own);
    const std::vector<float> values = values_at(*field, independent_positions(own));
    constexpr int kBins = 64;
    std::array<double, kBins> counts{};
    for (const float v : values) {
      ASSERT_GE(v, 0.0f);
      ASSERT_LE(v, 1.0f);
      counts[static_cast<std::size_t>(std::min(kBins - 1, static_cast<int>(v * kBins)))] += 1.0;
    }
    const double expected = static_cast<double>(values.size()) / kBins;
    double chi_square = 0.0;
    for (const double count : counts) chi_square += (count - expected) * (count - expected) / expected;
    EXPECT_GT(regularized_gamma_q(0.5 * (kBins - 1), 0.5 * chi_square), 1e-5)
        << "fold " << static_cast<int>(of.fold) << ", chi-square " << chi_square;
  }
}

TEST(LayeredField, LayersThatChangeNothingAreTheNoiseBitForBit) {
  const NoiseRecipe own = many_impulses(2);
  const Lattice<3> lattice{Vec<3>(0.0), Vec<3>(0.07), {-3, 5, 0}, {8, 8, 8}};
  const std::vector<float> noise = values_on(*make_plain(own), lattice);
  EXPECT_EQ(values_on(*make_field_of({Layer{}}, own), lattice), noise);
  EXPECT_EQ(values_on(*make_field_of({{.warp = Warp{.amount = 0.0}}}, own), lattice), noise);
}

// Noises round positions to 2^-20 of a cell of a kernel's size, about a wavelength: where a slope is 6 sigma,
// 6 2 pi F, values are 4e-5 off; displacements are floats, and their error comes on top.
constexpr double kRounding = 1.5e-4;

TEST(LayeredField, WarpDisplacesAsTheFormulaSays) {
  const NoiseRecipe own = many_impulses();
  Warp warp{.amount = 0.4, .noise = many_impulses()};
  std::get<GaborNoiseOptions>(warp.noise->noise).frequency = 0.5;
  const Layer layer{.warp = warp};
  const auto field = make_field_of({layer}, own);
  const Lattice<3> lattice{Vec<3>(0.0), Vec<3>(0.25), {-3, 5, 0}, {4, 4, 4}};
  const std::vector<float> on_lattice = values_on(*field, lattice);

  const auto noise = make_plain(own);
  const NoiseRecipe shifts = noise_of_layer(warp.noise, own);
  double difference = 0.0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Vec<3> position = sample_position(lattice, i);
    Vec<3> moved = position;
    for (int axis = 0; axis < 3; ++axis) {
      moved[axis] += 0.4 * static_cast<double>(value_at(*make_plain(channel_of(shifts, axis)), position));
    }
    const float expected = value_at(*noise, moved);
    EXPECT_NEAR(on_lattice[i], expected, kRounding);
    EXPECT_NEAR(values_at(*field, {position})[0], expected, kRounding);
    difference += std::abs(expected - value_at(*noise, position)) / static_cast<double>(lattice.size());
  }
  EXPECT_GT(difference, 0.5);  // 2 / sqrt(pi) = 1.1 for independent values
}

TEST(LayeredField, WarpedValuesDependOnThePositionOnly) {
  const auto field = make_field_of({{.fold = Fold::ridged, .warp = Warp{.amount = 30.0}}}, many_impulses(2));
  const Lattice<3> whole{Vec<3>(1e3), Vec<3>(0.3), {0, -8, 8}, {8, 8, 8}};
  const std::vector<float> values = values_on(*field, whole);
  for (const Index<3>& part : {Index<3>(0, 0, 0), Index<3>(3, 1, 4), Index<3>(7, 7, 7)}) {
    const Lattice<3> one{whole.origin, whole.step, whole.first + part, {1, 1, 1}};
    EXPECT_EQ(values_on(*field, one)[0],
              values[static_cast<std::size_t>((part.x * 8 + part.y) * 8 + part.z)]);
  }
}

// Volumes ask for the leaves of a block together.
TEST(LayeredField, ManyLatticesTogetherHaveTheValuesOfEach) {
  const NoiseRecipe own = many_impulses(2);
  const Layer plain{.stretch = Vec<3>(2.0, 1.0, 1.0)};
  const Layer warped{.fold = Fold::ridged, .warp = Warp{.amount = 0.5}};
  const Layer warped_twice{.layers = {plain, warped}, .warp = Warp{.amount = 0.3}};
  const auto field = side_by_side({make_field_of({plain}, own), make_field_of({warped}, own),
                                   warp(side_by_side({make_field_of({warped_twice}, own), make_plain(own)}),
                                        0.2, {make_plain(own), make_plain(own), make_plain(own)})});
  std::vector<Lattice<3>> lattices;
  for (const Index<3>& first : {Index<3>(0, 0, 0), Index<3>(0, 4, -8), Index<3>(16, 4, 4)}) {
    lattices.push_back({Vec<3>(0.1), Vec<3>(0.2), first, {4, 4, 4}});
  }
  const auto block = field->block({Vec<3>(-5.0), Vec<3>(5.0)});
  const std::size_t size = 4 * lattices.front().size();
  std::vector<float> together(size * lattices.size());
  block->evaluate_all(lattices, {together, {}});
  for (std::size_t i = 0; i < lattices.size(); ++i) {
    std::vector<float> one(size);
    block->evaluate(lattices[i], {one, {}});
    EXPECT_TRUE(std::ranges::equal(one, std::span(together).subspan(i * size, size))) << i;
  }
}

TEST(LayeredField, WarpedPeriodicNoiseStaysPeriodic) {
  NoiseRecipe own = many_impulses();
  std::get<GaborNoiseOptions>(own.noise).period = {8.0, 12.0, 16.0, 0.0};
  const auto field = make_field_of({{.warp = Warp{.amount = 0.7}}}, own);
  const Lattice<3> here{Vec<3>(0.1), Vec<3>(0.5), {-2, 0, 3}, {3, 3, 3}};
  Lattice<3> there = here;
  there.origin += Vec<3>(8.0, -24.0, 32.0);
  const std::vector<float> values = values_on(*field, here);
  const std::vector<float> repeated = values_on(*field, there);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], repeated[i], 2.0 * kRounding);
}

Layer constant(double value) {
  return {.weight = 0.0, .bias = value};
}

float value_of(const std::vector<Layer>& layers) {
  const auto field = make_field_of(layers);
  const Lattice<3> one{Vec<3>(0.5), Vec<3>(1.0), {0, 0, 0}, {1, 1, 1}};
  const float value = values_on(*field, one)[0];
  EXPECT_EQ(values_at(*field, {Vec<3>(0.5)})[0], value);
  return value;
}

TEST(LayeredField, CombinesLayers) {
  const auto combined = [](Combine combine, const std::vector<double>& values) {
    Layer layer{.combine = combine};
    for (const double value : values) layer.layers.push_back(constant(value));
    return value_of({layer});
  };
  EXPECT_EQ(combined(Combine::sum, {2.0, 3.0, -1.0}), 4.0f);
  EXPECT_EQ(combined(Combine::product, {2.0, 3.0, -1.0}), -6.0f);
  EXPECT_EQ(combined(Combine::max, {2.0, 3.0, -1.0}), 3.0f);
  EXPECT_EQ(combined(Combine::min, {2.0, 3.0, -1.0}), -1.0f);
  EXPECT_EQ(combined(Combine::mix, {2.0, 4.0, 0.25}), 2.5f);
  EXPECT_EQ(combined(Combine::mix, {2.0, 4.0, -3.0}), 2.0f);
  EXPECT_EQ(combined(Combine::mix, {2.0, 4.0, 3.0}), 4.0f);
  EXPECT_EQ(value_of({constant(1.0), constant(0.5)}), 1.5f);
}

TEST(LayeredField, RampsAreLinearBetweenTheirStops) {
  const auto ramped = [](double value) {
    Layer layer{.layers = {constant(value)}, .ramp = {{-1.0, 10.0}, {0.0, 20.0}, {2.0, 0.0}}};
    layer.weight = 2.0;
    layer.bias = 1.0;
    return value_of({layer});
  };
  EXPECT_EQ(ramped(-5.0), 21.0f);
  EXPECT_EQ(ramped(-1.0), 21.0f);
  EXPECT_EQ(ramped(-0.5), 31.0f);
  EXPECT_EQ(ramped(0.0), 41.0f);
  EXPECT_EQ(ramped(1.5), 11.0f);
  EXPECT_EQ(ramped(2.0), 1.0f);
  EXPECT_EQ(ramped(9.0), 1.0f);
}

// --seed makes another field of the whole tree; a layer's noise is independent of the recipe's.
TEST(LayeredField, SeedsOfLayersAreMixedWithTheRecipes) {
  const NoiseRecipe own = many_impulses();
  NoiseRecipe other = own;
  std::get<GaborNoiseOptions>(other.noise).seed = 6;
  const std::vector<Vec<3>> positions = independent_positions(own);
  const std::vector<float> of_own = values_at(*make_field_of({Layer{}}, own), positions);
  const std::vector<float> of_layer = values_at(*make_field_of({{.noise = own}}, own), positions);
  const std::vector<float> of_other = values_at(*make_field_of({{.noise = own}}, other), positions);
  expect_uncorrelated(of_own, of_layer);
  expect_uncorrelated(of_layer, of_other);
}

}  // namespace
}  // namespace solidnoise::layered_field_test
