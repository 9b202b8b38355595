#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <nlohmann/json.hpp>

#include "pictures.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise::studio {

// The spectrum of a slice: its periodogram as densities, frequency 0 in the middle, rows from the bottom; its
// mean over directions, and beside it what the noise's closed form says of it, where there is one.
Answer make_spectrum(const Json& question, std::span<const unsigned char> bytes) {
  Json whole = question;
  whole["first"] = {0, 0};
  whole["count"] = {question.at("plane").at("columns"), question.at("plane").at("rows")};
  Answer slice = make_slice(whole, bytes);
  const SliceSubject& subject = subject_of(question);
  DenseField<2> field({subject.plane.columns, subject.plane.rows}, Vec<2>(subject.plane.pixel));
  field.values = slice.floats.front();
  double mean = 0.0;
  for (const float value : field.values) mean += value;
  PeriodogramOptions options;
  const bool closed = !subject.plain.empty() && subject.plain.front().sigma > 0.0;
  if (!closed) options.mean = mean / static_cast<double>(field.values.size());
  const PowerSpectrum<2> measured = periodogram(field, options);

  Answer answer;
  std::vector<float> picture(measured.density.size());
  const glm::ivec2 count = measured.count;
  for (int x = 0; x < count.x; ++x) {
    for (int y = 0; y < count.y; ++y) {
      const glm::ivec2 stored((x + count.x - count.x / 2) % count.x, (y + count.y - count.y / 2) % count.y);
      picture[static_cast<std::size_t>(x * count.y + y)] =
          static_cast<float>(measured.density[ArrayShape<2>{count}.index(stored)]);
    }
  }
  answer.floats.push_back(std::move(picture));
  std::vector<float> frequencies;
  std::vector<float> powers;
  for (const RadialBin& bin : radial_average(measured)) {
    frequencies.push_back(static_cast<float>(bin.frequency));
    powers.push_back(static_cast<float>(bin.power));
  }
  answer.floats.push_back(frequencies);
  answer.floats.push_back(powers);
  answer.json["nyquist"] = 0.5 / subject.plane.pixel;
  if (!closed) return answer;

  const VolumeRecipe grid = at_resolution(timed_grid(question), Vec<3>(subject.plane.pixel));
  if (!grid.layers.empty()) return answer;
  const std::shared_ptr<const Noise<3>> noise = make_volume_noise(grid);
  const auto plane = on_plane(noise, {subject.plane.position(0, 0), subject.plane.right, subject.plane.up});
  // The mean over directions at the middles of the bins, a half-circle of them, as a density is even; one
  // where all are alike.
  const auto density = [&](double frequency, double angle) {
    return plane->power_spectrum({frequency * std::cos(angle), frequency * std::sin(angle)});
  };
  const Band band = plane->band();
  const double middle = 0.5 * (band.lower + band.upper);
  const double there = density(middle, 0.3);
  const int directions = std::abs(density(middle, 1.7) - there) < 1e-6 * there ? 1 : 8;
  std::vector<float> closed_form;
  for (const float frequency : frequencies) {
    double sum = 0.0;
    for (int k = 0; k < directions && frequency < 2.0 * band.upper; ++k) {
      sum += density(frequency, std::numbers::pi * (k + 0.5) / directions);
    }
    closed_form.push_back(static_cast<float>(sum / directions));
  }
  answer.floats.push_back(closed_form);
  return answer;
}

}  // namespace solidnoise::studio
