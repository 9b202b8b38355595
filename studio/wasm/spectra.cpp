#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "pictures.h"
#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/analysis/radial_spectrum.h"
#include "solidnoise/field/shaping.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/volume/volume_field.h"

namespace solidnoise::studio {
namespace {

// A range ends at 3: of a noise of this deviation, as octaves that are not renormalised may have, 3 % of the
// variance is beyond.
constexpr double kMostSigmaInRange = 1.25;

// The values of a slice as those of its noise, times a factor, about a mean.
struct LinearRange {
  double factor;
  double mean;
};

// None where they are of more than a noise, or a range cuts much of it off.
std::optional<LinearRange> linear_range(const SliceSubject& subject, const VolumeRecipe& grid) {
  if (subject.color_of) return {};
  const double sigma = subject.sigma;
  const RawShaping::Range range = std::get<RawShaping>(grid.shaping).range;
  if (sigma == 0.0 || (range != RawShaping::Range::raw && sigma > kMostSigmaInRange)) return {};
  std::array<float, 2> mapped{0.0f, 1.0f};
  to_range(range, mapped);
  return LinearRange{mapped[1] - mapped[0], mapped[0]};
}

}  // namespace

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
  double total = 0.0;
  for (const float value : field.values) total += value;
  const VolumeRecipe timed = timed_grid(question);
  const std::optional<LinearRange> closed = linear_range(subject, timed);
  PeriodogramOptions options;
  options.mean = closed ? closed->mean : total / static_cast<double>(field.values.size());
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

  const VolumeRecipe grid = at_resolution(timed, Vec<3>(subject.plane.pixel));
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
    closed_form.push_back(static_cast<float>(closed->factor * closed->factor * sum / directions));
  }
  answer.floats.push_back(closed_form);
  return answer;
}

}  // namespace solidnoise::studio
