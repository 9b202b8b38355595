#include "solidnoise/analysis/exemplar/gaussianity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/analysis/exemplar/periodic_component.h"
#include "solidnoise/core/moments.h"

namespace solidnoise {
namespace {

constexpr std::array kDistances{1, 2, 4, 8};
// Above these an eye tells the texture from its Gaussian version at once.
constexpr double kStructure = 1.5;
constexpr double kSkewness = 1.0;
constexpr double kSignificance = 5.0;

// Excess kurtosis of the differences along both axes, of a field that is periodic.
double difference_kurtosis(const DenseField<2>& field, int distance) {
  std::vector<float> differences;
  differences.reserve(2 * field.size());
  const ArrayShape<2> shape{field.count};
  for (int x = 0; x < field.count.x; ++x) {
    for (int y = 0; y < field.count.y; ++y) {
      const float value = field.values[shape.index({x, y})];
      differences.push_back(field.values[shape.index({(x + distance) % field.count.x, y})] - value);
      differences.push_back(field.values[shape.index({x, (y + distance) % field.count.y})] - value);
    }
  }
  return Moments::of(differences).excess_kurtosis();
}

}  // namespace

GaussianityReport test_gaussianity(const DenseField<2>& field, int versions, std::uint64_t seed) {
  GaussianityReport report;
  const Moments moments = Moments::of(field.values);
  report.skewness = moments.skewness();
  report.excess_kurtosis = moments.excess_kurtosis();

  const Exemplar<2> exemplar{{field}};
  const DenseField<2> periodic = periodic_component(field);
  std::array<double, kDistances.size()> sum{};
  std::array<double, kDistances.size()> squares{};
  for (int i = 0; i < versions; ++i) {
    const DenseField<2> version =
        gaussian_version(exemplar, seed + static_cast<std::uint64_t>(i)).channels.front();
    for (std::size_t d = 0; d < kDistances.size(); ++d) {
      const double kurtosis = difference_kurtosis(version, kDistances[d]);
      sum[d] += kurtosis;
      squares[d] += kurtosis * kurtosis;
    }
  }
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    const double mean = sum[d] / versions;
    const double variance = std::max(0.0, squares[d] / versions - mean * mean) * versions / (versions - 1);
    const double excess = difference_kurtosis(periodic, kDistances[d]) - mean;
    if (std::abs(excess) <= std::abs(report.structure)) continue;
    report.structure = excess;
    report.structure_distance = kDistances[d];
    report.significance = std::abs(excess) / std::sqrt(variance * (1.0 + 1.0 / versions) + 1e-12);
  }

  if (std::abs(report.structure) > kStructure && report.significance > kSignificance) {
    report.warnings.push_back(fmt::format(
        "the exemplar is structured (edges, shapes: {:.2g}, a Gaussian texture has 0); noise cannot "
        "show that, only its Gaussian version",
        report.structure));
  }
  if (std::abs(report.skewness) > kSkewness) {
    report.warnings.push_back(fmt::format(
        "the exemplar's values are lopsided (skewness {:.2g}); noise is symmetric: its darkest and "
        "brightest parts will differ",
        report.skewness));
  }
  return report;
}

}  // namespace solidnoise
