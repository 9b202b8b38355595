#include "solidnoise/analysis/parallel_evaluation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise::parallel_evaluation_test {
namespace {

// Stops after the first report, or never.
class CountingProgress final : public Progress {
 public:
  explicit CountingProgress(bool stops) : stops_(stops) {}
  void advance(std::uint64_t done, std::uint64_t total) override {
    if (done == total) ++ends;
    begun_ = true;
  }
  bool cancelled() override { return stops_ && begun_; }
  std::atomic<int> ends{0};

 private:
  bool stops_;
  std::atomic<bool> begun_{false};
};

TEST(ParallelEvaluation, GivesALatticeTheNoisesOwnValues) {
  const auto noise = make_noise<3>({.noise = GaborNoiseOptions{.frequency = 4.0}, .fractal = {.octaves = 2}});
  const Lattice<3> lattice{.step = Vec<3>(0.02), .first = {-7, 3, 100}, .count = {40, 33, 65}};
  std::vector<float> expected(lattice.size() * 4);
  std::vector<float> found(lattice.size() * 4);
  const auto samples = [&](std::vector<float>& memory) {
    const auto part = [&](std::size_t k) {
      return std::span(memory).subspan(k * lattice.size(), lattice.size());
    };
    return Samples<3>{part(0), {part(1), part(2), part(3)}};
  };
  noise->evaluate(lattice, samples(expected));
  CountingProgress progress(false);
  evaluate_in_parallel<3>(*noise, lattice, samples(found), &progress);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(progress.ends, 1);
}

TEST(ParallelEvaluation, GivesPointsInAnyOrderTheNoisesOwnValues) {
  const auto noise = make_noise<2>({.noise = GaborNoiseOptions{.frequency = 4.0}, .fractal = {}});
  std::vector<Vec<2>> positions;
  for (int i = 0; i < 40000; ++i) {  // several batches, far from their neighbours
    positions.emplace_back(5.0 * std::fmod(0.618034 * i, 1.0), 5.0 * std::fmod(0.754878 * i, 1.0));
  }
  std::vector<float> expected(positions.size());
  std::vector<float> found(positions.size());
  noise->evaluate(Points<2>{positions}, Samples<2>{expected, {}});
  const PointSource<2> source{positions.size(), [&](std::size_t first, std::span<Vec<2>> slab) {
                                std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(first),
                                            slab.size(), slab.begin());
                              }};
  evaluate_in_parallel<2>(*noise, source, Samples<2>{found, {}});
  EXPECT_EQ(found, expected);
}

TEST(ParallelEvaluation, StopsAndRefuses) {
  const auto noise = make_noise<1>({.noise = GaborNoiseOptions{.frequency = 4.0}, .fractal = {}});
  const Lattice<1> lattice{.step = Vec<1>(0.001), .count = glm::vec<1, int>(1 << 20)};
  std::vector<float> values(lattice.size());
  CountingProgress progress(true);
  EXPECT_THROW(evaluate_in_parallel<1>(*noise, lattice, Samples<1>{values, {}}, &progress), Cancelled);
  EXPECT_THROW(evaluate_in_parallel<1>(*noise, lattice, Samples<1>{std::span(values).first(9), {}}),
               std::invalid_argument);
  const PointSource<1> nowhere{1, [](std::size_t, std::span<Vec<1>> slab) {
                                 slab.front() = Vec<1>(std::numeric_limits<double>::quiet_NaN());
                               }};
  EXPECT_THROW(evaluate_in_parallel<1>(*noise, nowhere, Samples<1>{values, {}}), std::invalid_argument);
}

}  // namespace
}  // namespace solidnoise::parallel_evaluation_test
