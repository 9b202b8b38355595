#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/field.h"
#include "solidnoise/field/graded_field.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise::room_test {
namespace {

std::shared_ptr<const Noise<3>> gabor(std::uint64_t seed) {
  return make_noise<3>({.noise = GaborNoiseOptions{.frequency = 4.0, .seed = seed}});
}

std::vector<std::pair<std::string, FieldPtr>> fields() {
  const auto constant = shape(stretched(gabor(9), Vec<3>(1e6)), RawShaping{.range = RawShaping::Range::unit});
  CurlOptions curl;
  curl.potentials = {gabor(1), gabor(2), gabor(3)};
  return {{"curl", make_curl_field(curl)},
          {"side by side", side_by_side({gabor(1), gradient_of(gabor(2))})},
          {"phasor", phasor_of(gabor(1), gabor(2))},
          {"gradient", gradient_of(gabor(1))},
          {"value and gradient", value_and_gradient_of(gabor(1))},
          {"sum", combine(Layer::Combine::sum, {gabor(1), gabor(2)})},
          {"masked", masked(gradient_of(gabor(1)), gabor(2))},
          {"shared", share(gabor(1))},
          {"warped", warp(gabor(1), 0.1, {gabor(2), gabor(3), gabor(4)})},
          {"unit", shape(gabor(1), RawShaping{.range = RawShaping::Range::unit})},
          {"veins", shape(gabor(1), VeinShaping{})},
          {"graded", make_graded_field({constant, 1.0, 2.0}, 1.0, [](double, int grade) {
             return gabor(static_cast<std::uint64_t>(100 + grade));
           })}};
}

// Nothing is written beyond what there is room for: by no way to evaluate, for no kind of field.
TEST(Room, IsAskedForByEveryField) {
  const Lattice<3> lattice{.step = Vec<3>(0.02), .count = {9, 8, 7}};
  const std::vector<Vec<3>> positions(lattice.size(), Vec<3>(0.5));
  for (const auto& [name, field] : fields()) {
    const std::size_t needed = lattice.size() * static_cast<std::size_t>(field->channels());
    const auto block = field->block(lattice.bounds());
    for (const std::size_t room : {std::size_t{1}, needed / 2, needed - 1}) {
      SCOPED_TRACE(name + ", room for " + std::to_string(room));
      std::vector<float> memory(2 * needed, -7.0f);
      const Samples<3> samples{std::span(memory).first(room), {}};
      EXPECT_THROW(field->evaluate(Points<3>{positions}, samples), std::invalid_argument);
      EXPECT_THROW(block->evaluate(lattice, samples), std::invalid_argument);
      const auto beyond = memory.begin() + static_cast<std::ptrdiff_t>(room);
      EXPECT_TRUE(std::all_of(beyond, memory.end(), [](float value) { return value == -7.0f; }));
    }
    std::vector<float> enough(needed);
    EXPECT_NO_THROW(block->evaluate(lattice, {enough, {}}));
  }
}

}  // namespace
}  // namespace solidnoise::room_test
