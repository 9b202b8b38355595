#include "solidnoise/analysis/exemplar/exemplar.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "solidnoise/analysis/exemplar/gaussian_field.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/core/named_error.h"
#include "solidnoise/image/color.h"
#include "solidnoise/image/image_file.h"

namespace solidnoise {
namespace {

constexpr int kFewestSamples = 16;  // two bands of frequencies

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw std::invalid_argument(name + ": " + what);
}

void require_opaque(const Image& image, const std::string& name) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float alpha = image.at(x, y, image.channels - 1);
      if (alpha == 1.0f) continue;
      refuse(name, fmt::format("has an alpha channel, which is {} at ({}, {}); flatten it onto a background "
                               "first, an exemplar is opaque",
                               alpha, x, y));
    }
  }
}

bool is_grey(const Image& image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float red = image.at(x, y, 0);
      if (image.at(x, y, 1) != red || image.at(x, y, 2) != red) return false;
    }
  }
  return true;
}

}  // namespace

bool holds_linear_light(const std::filesystem::path& path) {
  constexpr std::string_view kLinear[] = {".exr", ".hdr", ".rgbe", ".pic"};
  return std::ranges::find(kLinear, extension_of(path)) != std::end(kLinear);
}

template <int Dim>
void Exemplar<Dim>::validate(const std::string& name) const {
  if (channels.size() != 1 && channels.size() != 3) {
    refuse(name, fmt::format("has {} channels; it must have 1 or 3", channels.size()));
  }
  for (const DenseField<Dim>& channel : channels) {
    if (channel.count != shape().count || channel.step != shape().step ||
        channel.values.size() != shape().size()) {
      refuse(name, "its channels have different shapes");
    }
  }
  for (int axis = 0; axis < Dim; ++axis) {
    if (shape().count[axis] < kFewestSamples) {
      refuse(name, fmt::format("has {} samples along an axis; it must have at least {}", shape().count[axis],
                               kFewestSamples));
    }
  }
  bool constant = true;
  for (const DenseField<Dim>& channel : channels) {
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (!std::isfinite(channel.values[i])) {
        refuse(name, fmt::format("has a value that is not finite ({})", channel.values[i]));
      }
      constant = constant && channel.values[i] == channel.values.front();
    }
  }
  if (constant) refuse(name, "is constant; there is no texture in it");
}

Exemplar<2> exemplar_of_image(const Image& image, const ExemplarReading& reading, const std::string& name) {
  require_positive("pixel_size", reading.pixel_size, "world units");
  if (image.channels < 1 || image.channels > 4) {
    refuse(name, fmt::format("has {} channels; it must have 1 or 3", image.channels));
  }
  if (image.channels % 2 == 0) require_opaque(image, name);
  const int channels = image.channels <= 2 || is_grey(image) ? 1 : 3;
  Exemplar<2> result;
  for (int c = 0; c < channels; ++c) {
    DenseField<2>& field =
        result.channels.emplace_back(glm::ivec2(image.width, image.height), Vec<2>(reading.pixel_size));
    for (int x = 0; x < image.width; ++x) {
      for (int y = 0; y < image.height; ++y) {
        const float stored = image.at(x, image.height - 1 - y, c);
        field.values[static_cast<std::size_t>(x) * static_cast<std::size_t>(image.height) +
                     static_cast<std::size_t>(y)] = reading.raw_values ? stored : linear_from_srgb(stored);
      }
    }
  }
  result.validate(name);
  return result;
}

Exemplar<2> read_exemplar(const std::filesystem::path& path, const ExemplarReading& reading,
                          Progress* progress, const std::function<void(std::uint64_t)>& before) {
  ExemplarReading as_stored = reading;
  if (holds_linear_light(path)) as_stored.raw_values = true;
  const Image image = read_image(path, progress, before);
  return as_file_error([&] { return exemplar_of_image(image, as_stored, path.string()); });
}

Exemplar<2> middle_slice(const Exemplar<3>& volume) {
  Exemplar<2> slice;
  for (const DenseField<3>& channel : volume.channels) {
    DenseField<2>& field = slice.channels.emplace_back(glm::ivec2(channel.count), Vec<2>(channel.step));
    const ArrayShape<3> from{channel.count};
    const ArrayShape<2> to{field.count};
    for (std::size_t i = 0; i < field.size(); ++i) {
      field.values[i] = channel.values[from.index({to.position(i), channel.count.z / 2})];
    }
  }
  return slice;
}

Image image_of_exemplar(const Exemplar<2>& exemplar) {
  const glm::ivec2 count = exemplar.shape().count;
  Image image(count.x, count.y, 3);
  for (int c = 0; c < 3; ++c) {
    const DenseField<2>& field =
        exemplar.channels.size() == 1 ? exemplar.channels[0] : exemplar.channels[static_cast<std::size_t>(c)];
    for (int x = 0; x < count.x; ++x) {
      for (int y = 0; y < count.y; ++y) {
        image.at(x, count.y - 1 - y, c) =
            field.values[static_cast<std::size_t>(x) * static_cast<std::size_t>(count.y) +
                         static_cast<std::size_t>(y)];
      }
    }
  }
  return image;
}

template struct Exemplar<2>;
template struct Exemplar<3>;

namespace {

constexpr std::array kDistances{1, 2, 4, 8};
// Above these an eye tells the texture from its Gaussian version at once.
constexpr double kStructure = 0.6;
constexpr double kSkewness = 1.0;
constexpr double kSignificance = 5.0;
constexpr std::array kDetailDistances{1, 2, 4};
// Soil, earth and moss have 1.5 to 1.7, sand, leaves, rock and wood 2.3 to 4.
constexpr double kUnevenness = 2.0;

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

// The mean over 2 r + 1 samples along an axis of a periodic field.
void blur(std::vector<double>& values, const glm::ivec2& count, int axis, int r) {
  const auto n = static_cast<std::size_t>(count[axis]);
  const auto rows = static_cast<std::size_t>(count[1 - axis]);
  const std::size_t step = axis == 0 ? static_cast<std::size_t>(count[1]) : 1;
  const std::size_t row_step = axis == 0 ? 1 : static_cast<std::size_t>(count[1]);
  const auto reach = static_cast<std::size_t>(r) % n;
  std::vector<double> row(n);
  for (std::size_t k = 0; k < rows; ++k) {
    double* const first = values.data() + k * row_step;
    for (std::size_t i = 0; i < n; ++i) row[i] = first[i * step];
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * reach + 1; ++i) sum += row[(i + n - reach) % n];
    for (std::size_t i = 0; i < n; ++i) {
      first[i * step] = sum / static_cast<double>(2 * reach + 1);
      sum += row[(i + reach + 1) % n] - row[(i + n - reach) % n];
    }
  }
}

// Of the local energy of the detail at a distance; the field is periodic.
double energy_variation(const DenseField<2>& field, int distance) {
  const ArrayShape<2> shape{field.count};
  const glm::ivec2 n = field.count;
  std::vector<double> energy(field.size());
  for (int x = 0; x < n.x; ++x) {
    for (int y = 0; y < n.y; ++y) {
      const auto at = [&](int dx, int dy) {
        return static_cast<double>(
            field.values[shape.index({(x + dx + 8 * n.x) % n.x, (y + dy + 8 * n.y) % n.y})]);
      };
      const double around = at(distance, 0) + at(-distance, 0) + at(0, distance) + at(0, -distance);
      const double detail = at(0, 0) - 0.25 * around;
      energy[shape.index({x, y})] = detail * detail;
    }
  }
  constexpr int kNeighbourhood = 4;  // distances to each side
  for (const int axis : {0, 1}) blur(energy, n, axis, kNeighbourhood * distance);
  double mean = 0.0;
  double square = 0.0;
  for (const double value : energy) {
    mean += value / static_cast<double>(energy.size());
    square += value * value / static_cast<double>(energy.size());
  }
  return mean > 0.0 ? std::sqrt(std::max(0.0, square / (mean * mean) - 1.0)) : 0.0;
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
  std::array<double, kDetailDistances.size()> energies{};
  for (int i = 0; i < versions; ++i) {
    const DenseField<2> version =
        gaussian_version(exemplar, seed + static_cast<std::uint64_t>(i)).channels.front();
    for (std::size_t d = 0; d < kDistances.size(); ++d) {
      const double kurtosis = difference_kurtosis(version, kDistances[d]);
      sum[d] += kurtosis;
      squares[d] += kurtosis * kurtosis;
    }
    for (std::size_t d = 0; d < kDetailDistances.size(); ++d) {
      energies[d] += energy_variation(version, kDetailDistances[d]) / versions;
    }
  }
  for (std::size_t d = 0; d < kDistances.size(); ++d) {
    const double mean = sum[d] / versions;
    const double variance = std::max(0.0, squares[d] / versions - mean * mean) * versions / (versions - 1);
    const double excess = difference_kurtosis(periodic, kDistances[d]) - mean;
    if (std::abs(excess) <= std::abs(report.structure)) continue;
    report.structure = excess;
    report.significance = std::abs(excess) / std::sqrt(variance * (1.0 + 1.0 / versions) + 1e-12);
  }

  std::array<double, kDetailDistances.size()> ratios{};
  for (std::size_t d = 0; d < kDetailDistances.size(); ++d) {
    ratios[d] = energy_variation(periodic, kDetailDistances[d]) / std::max(energies[d], 1e-12);
  }
  std::sort(ratios.begin(), ratios.end());
  report.unevenness = ratios[1];

  const bool has_edges = std::abs(report.structure) > kStructure && report.significance > kSignificance;
  if (has_edges || report.unevenness > kUnevenness) {
    report.warnings.push_back(
        fmt::format("the exemplar has structure (edges: {:.2g}, a Gaussian texture has 0; shapes: {:.2g}, it "
                    "has 1); noise "
                    "cannot show that, only its Gaussian version",
                    report.structure, report.unevenness));
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
