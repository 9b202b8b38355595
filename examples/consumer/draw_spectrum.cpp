// Draws a slice of noise, and compares the power that its periodogram has with the closed form.
#include <iostream>

#include "solidnoise/analysis/field_picture.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/noise/registry/noise_recipe.h"

int main() {
  const auto noise =
      solidnoise::make_noise<2>({.noise = solidnoise::GaborNoiseOptions{.frequency = 16.0, .seed = 7}});

  const double pixel = 1.0 / 256.0;
  solidnoise::DenseField<2> field({256, 256}, {pixel, pixel});
  noise->evaluate({.step = {pixel, pixel}, .count = {256, 256}}, {.values = field.values});

  std::cout << "power in the periodogram " << solidnoise::periodogram(field).variance() << '\n'
            << "closed form              " << noise->variance() << '\n';
  const auto ramp = solidnoise::parse_color_ramp("grey");
  solidnoise::write_image("noise.png", solidnoise::field_picture(field, 256, ramp, -3.0, 3.0));
}
