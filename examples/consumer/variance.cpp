// Fills a block with noise and compares its variance with the closed form.
#include <iostream>
#include <numeric>
#include <vector>

#include "solidnoise/noise/registry/noise_recipe.h"

int main() {
  const auto noise =
      solidnoise::make_noise<3>({.noise = solidnoise::GaborNoiseOptions{.frequency = 4.0, .seed = 7}});

  const double voxel = 1.0 / 32.0;
  const solidnoise::Lattice<3> lattice{.step = {voxel, voxel, voxel}, .count = {128, 128, 128}};
  std::vector<float> values(lattice.size());
  noise->evaluate(lattice, {.values = values});

  const double sum_of_squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  std::cout << "measured variance " << sum_of_squares / static_cast<double>(values.size()) << '\n'
            << "closed form       " << noise->variance() << '\n';
}
