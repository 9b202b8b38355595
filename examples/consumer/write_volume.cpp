// Fills a sphere with noise and writes it as an OpenVDB grid.
#include <iostream>

#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/vdb/vdb_write.h"

int main() {
  const std::shared_ptr<const solidnoise::Noise<3>> noise =
      solidnoise::make_noise<3>({.noise = solidnoise::GaborNoiseOptions{.frequency = 4.0, .seed = 7}});

  const solidnoise::GridFrame frame(1.0 / 32.0);
  const auto sphere = solidnoise::sphere_topology(frame, {0.0, 0.0, 0.0}, 1.0);
  const auto filled = solidnoise::fill_grid(sphere, *noise, solidnoise::Sparsity::keep);

  filled.grid->setName("noise");
  solidnoise::write_vdb("noise.vdb", {filled.grid},
                        {.existing = solidnoise::Existing::replace, .creator = "consumer"});
  std::cout << "noise.vdb: " << filled.grid->activeVoxelCount() << " voxels\n";
}
