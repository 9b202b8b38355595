#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/core/random.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "support/each_dimension.h"
#include "support/gabor_noises.h"
#include "support/independent_values.h"

namespace solidnoise::gabor_independence_test {
namespace {

// The same noise of another seed.
template <template <int> class Noise, int Dim>
Noise<Dim> with_seed(const Noise<Dim>& noise, std::uint64_t seed) {
  auto options = noise.options();
  options.seed = seed;
  return Noise<Dim>(options);
}

TEST(GaborIndependence, SeedsMakeIndependentNoises) {
  for_each_dimension([]<int Dim>() {
    for_each_gabor_noise<Dim>([](const auto& noise) {
      const Lattice<Dim> lattice = independent_lattice<Dim>(support_of(noise));
      const auto first = values_of<Dim>(with_seed(noise, 1), lattice);
      for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{1} << 40}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        expect_uncorrelated(first, values_of<Dim>(with_seed(noise, seed), lattice));
        // Nor is one a copy of the other a cell further on.
        Lattice<Dim> shifted = lattice;
        shifted.origin[Dim - 1] += support_of(noise);
        expect_uncorrelated(first, values_of<Dim>(with_seed(noise, seed), shifted));
      }
    });
  });
}

TEST(GaborIndependence, ValuesThatShareNoImpulseAreIndependent) {
  for_each_dimension([]<int Dim>() {
    for_each_gabor_noise<Dim>([](const auto& noise) {
      const Lattice<Dim> lattice = independent_lattice<Dim>(support_of(noise));
      const auto values = values_of<Dim>(noise, lattice);
      for (int axis = 0; axis < Dim; ++axis) {
        // The nearest neighbour, of every other sample: products of pairs that have no sample in common.
        SCOPED_TRACE(testing::Message() << "axis " << axis);
        std::vector<float> here;
        std::vector<float> there;
        std::size_t stride = 1;
        for (int a = Dim - 1; a > axis; --a) stride *= static_cast<std::size_t>(lattice.count[a]);
        const std::size_t count = static_cast<std::size_t>(lattice.count[axis]);
        for (std::size_t i = 0; i < values.size(); ++i) {
          const std::size_t along = i / stride % count;
          if (along % 2 == 1 || along + 1 == count) continue;
          here.push_back(values[i]);
          there.push_back(values[i + stride]);
        }
        expect_uncorrelated(here, there);
      }
    });
  });
}

TEST(GaborIndependence, ChannelsDifferAlsoWherePeriodic) {
  // A colour's channels are noises of seeds derived from one. With periods of a few cells, a channel that
  // were a shifted copy of another would agree with it at some shift by whole cells. In 1D to 3D.
  for_each_dimension([]<int Dim>() {
    const auto check = [](const auto& noise) {
      constexpr std::int64_t kCells = 3;
      constexpr std::array kTiles = {40, 14, 5};  // of 3^n samples: about 120 of them
      auto options = noise.options();
      options.period = Vec<4>(kCells * support_of(noise) * 1.001);
      const std::decay_t<decltype(noise)> periodic(options);
      Lattice<Dim> tile;
      tile.step = Vec<Dim>(options.period[0] / kCells);
      tile.count = glm::vec<Dim, int>(kCells);
      double count = 0.0;
      std::vector<double> products(tile.size());  // summed, per shift
      for (int i = 0; i < kTiles[Dim - 1]; ++i) {
        const auto channel = [&](std::uint64_t stream) {
          return with_seed(periodic, derive_seed(static_cast<std::uint64_t>(100 + i), stream));
        };
        const auto red = values_of<Dim>(channel(0), tile);
        const auto green = channel(1);
        for (std::size_t shift = 0; shift < tile.size(); ++shift) {
          Lattice<Dim> shifted = tile;
          std::int64_t rest = static_cast<std::int64_t>(shift);
          for (int axis = 0; axis < Dim; ++axis) {
            shifted.first[axis] += rest % kCells;
            rest /= kCells;
          }
          const auto values = values_of<Dim>(green, shifted);
          for (std::size_t k = 0; k < values.size(); ++k) {
            products[shift] += static_cast<double>(red[k]) * static_cast<double>(values[k]);
          }
        }
        count += static_cast<double>(red.size());
      }
      // A copy would have a correlation of 1. Samples a cell apart share impulses near the ends of kernels
      // only, and count as nearly independent: 0.5 is more than 4 standard errors.
      for (const double product : products) EXPECT_LT(std::abs(product / count), 0.5);
    };
    if constexpr (Dim < 4) for_each_gabor_noise<Dim>(check);
  });
}

TEST(GaborIndependence, OctavesAreNotCopiesOfEachOther) {
  for_each_dimension([]<int Dim>() {
    // An octave of the same seed would be the first one, shrunk by the lacunarity.
    const GaborNoiseOptions options{.impulses = 20.0, .seed = 9};
    NoiseRecipe recipe{options, {.octaves = 2, .lacunarity = 2.0, .gain = 0.5, .renormalize = false}};
    const auto both = make_noise<Dim>(recipe);
    const GaborNoise<Dim> first(with_truncation_share(options));
    const Lattice<Dim> lattice = independent_lattice<Dim>(first.radius());
    Lattice<Dim> shrunk = lattice;
    shrunk.origin *= 0.5;
    shrunk.step *= 0.5;
    const auto here = values_of<Dim>(first, lattice);
    auto second = values_of<Dim>(*both, shrunk);
    const auto first_there = values_of<Dim>(first, shrunk);
    for (std::size_t i = 0; i < second.size(); ++i) second[i] = 2.0f * (second[i] - first_there[i]);
    expect_within_4_sigma(estimate_mean(second, [](double x) { return x * x; }), 1.0);
    expect_uncorrelated(here, second);
  });
}

}  // namespace
}  // namespace solidnoise::gabor_independence_test
