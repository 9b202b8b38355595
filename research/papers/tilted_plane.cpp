#include "papers/tilted_plane.h"

#include <cmath>
#include <memory>

#include "solidnoise/noise/gabor/gabor_noise.h"

namespace solidnoise::papers {
namespace {

constexpr double kHeight = 1.0;           // of the eye above the plane
constexpr double kFocus = 1.2;            // distance of the picture, in its widths
constexpr double kHeightFrequency = 2.5;  // cycles per unit of height
constexpr double kFilter = 0.5;           // standard deviation, pixels

// The row of the plane that a row of pixels sees.
struct Row {
  double depth = 0.0;   // on the plane, from the eye
  double across = 0.0;  // widths of a pixel's footprint
  double along = 0.0;
};

Row row_at(const TiltedPlaneOptions& options, int row) {
  // Pixels below the horizon, which is just above the picture.
  const double below = (options.rows - row + 0.5) / options.columns;
  const double pixel = 1.0 / options.columns;
  const double depth = kHeight * kFocus / below;
  return {depth, depth * pixel / kFocus, depth * pixel / below};
}

GaborNoise<2> make_noise(const TiltedPlaneOptions& options, double filter) {
  GaborNoiseOptions noise;
  noise.frequency = kHeightFrequency;
  noise.error = 0.005;
  noise.impulses = 32.0;
  noise.seed = options.seed;
  noise.filter = filter;
  return GaborNoise<2>(noise);
}

// Values on a straight line of the plane, from x to the right in steps.
std::vector<float> values_along(const GaborNoise<2>& noise, double x, double step, double depth, int count) {
  std::vector<Vec<2>> positions;
  for (int i = 0; i < count; ++i) positions.emplace_back(x + step * i, depth);
  std::vector<float> values(positions.size());
  noise.evaluate(Points<2>{positions}, {.values = values});
  return values;
}

// The Gaussian mean of the noise around each of the samples of a line, by a square of samples to 3 standard
// deviations on each side.
std::vector<float> averaged_along(const GaborNoise<2>& noise, const Row& row, double x, int count,
                                  int samples) {
  const double deviation = kFilter * row.along;
  std::vector<double> sums(static_cast<std::size_t>(count));
  double weights = 0.0;
  for (int i = 0; i < samples; ++i) {
    for (int j = 0; j < samples; ++j) {
      const double u = 6.0 * (i + 0.5) / samples - 3.0;
      const double v = 6.0 * (j + 0.5) / samples - 3.0;
      const double weight = std::exp(-0.5 * (u * u + v * v));
      const std::vector<float> values =
          values_along(noise, x + deviation * u, row.across, row.depth + deviation * v, count);
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += weight * values[k];
      weights += weight;
    }
  }
  std::vector<float> result;
  for (const double sum : sums) result.push_back(static_cast<float>(sum / weights));
  return result;
}

double root_mean_square(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += static_cast<double>(value) * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void put_row(DenseField<2>& field, int row, const std::vector<float>& values) {
  for (int column = 0; column < field.count.x; ++column) {
    field.values[ArrayShape<2>{field.count}.index({column, row})] = values[static_cast<std::size_t>(column)];
  }
}

}  // namespace

TiltedPlane tilted_plane(const TiltedPlaneOptions& options) {
  TiltedPlane plane;
  plane.sampled = DenseField<2>({options.columns, options.rows}, Vec<2>(1.0));
  plane.filtered = plane.sampled;
  plane.averaged = plane.sampled;
  const GaborNoise<2> noise = make_noise(options, 0.0);
  for (int row = 0; row < options.rows; ++row) {
    const Row seen = row_at(options, row);
    const double left = seen.across * 0.5 * (1.0 - options.columns);
    const GaborNoise<2> filtered = make_noise(options, kFilter * seen.along);
    const std::vector<float> sampled = values_along(noise, left, seen.across, seen.depth, options.columns);
    const std::vector<float> closed = values_along(filtered, left, seen.across, seen.depth, options.columns);
    const std::vector<float> averaged = averaged_along(noise, seen, left, options.columns, options.samples);
    std::vector<float> difference;
    for (std::size_t i = 0; i < closed.size(); ++i) difference.push_back(closed[i] - averaged[i]);
    put_row(plane.sampled, row, sampled);
    put_row(plane.filtered, row, closed);
    put_row(plane.averaged, row, averaged);
    plane.cycles_per_pixel.push_back(kHeightFrequency * seen.along);
    plane.sampled_rms.push_back(root_mean_square(sampled));
    plane.filtered_rms.push_back(root_mean_square(closed));
    plane.expected_rms.push_back(std::sqrt(filtered.variance()));
    plane.difference_rms.push_back(root_mean_square(difference));
  }
  return plane;
}

}  // namespace solidnoise::papers
