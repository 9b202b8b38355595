#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "solidnoise/analysis/expected_spectrum.h"

namespace solidnoise {
namespace {

template <int Dim>
double dot(const Vec<Dim>& a, const Vec<Dim>& b) {
  double sum = 0.0;
  for (int axis = 0; axis < Dim; ++axis) sum += a[axis] * b[axis];
  return sum;
}

template <int Dim>
double length(const Vec<Dim>& vector) {
  return std::sqrt(dot(vector, vector));
}

// Between the second and the third of four equidistant values, t from 0 to 1 (Catmull and Rom).
double interpolate(const std::array<double, 4>& v, double t) {
  return v[1] +
         0.5 * t *
             (v[2] - v[0] +
              t * (2.0 * v[0] - 5.0 * v[1] + 4.0 * v[2] - v[3] + t * (3.0 * (v[1] - v[2]) + v[3] - v[0])));
}

// An even function by its values at 0, spacing, 2 spacing ...; 0 beyond the last one.
class RadialTable {
 public:
  RadialTable(double spacing, std::vector<double> values)
      : per_unit_(1.0 / spacing), values_(std::move(values)) {}

  double operator()(double r) const {
    const double at = r * per_unit_;
    const std::size_t i = static_cast<std::size_t>(at);
    if (i + 2 >= values_.size()) return 0.0;
    const double value =
        interpolate({values_[i == 0 ? 1 : i - 1], values_[i], values_[i + 1], values_[i + 2]},
                    at - static_cast<double>(i));
    return std::max(value, 0.0);
  }

 private:
  double per_unit_;
  std::vector<double> values_;
};

// A function of two variables, even in each, on a square grid; 0 beyond the last row and column.
class AxialTable {
 public:
  template <typename Function>
  AxialTable(double spacing, std::size_t count, const Function& function)
      : spacing_(spacing), count_(count), values_(count * count) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        values_[i * count + j] = function(static_cast<double>(i) * spacing, static_cast<double>(j) * spacing);
      }
    }
  }

  double operator()(double along, double across) const {
    const double x = std::abs(along) / spacing_;
    const double y = std::abs(across) / spacing_;
    const std::size_t i = static_cast<std::size_t>(x);
    const std::size_t j = static_cast<std::size_t>(y);
    if (i + 2 >= count_ || j + 2 >= count_) return 0.0;
    std::array<double, 4> columns{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t row = i + k == 0 ? 1 : i + k - 1;
      const double* const v = &values_[row * count_];
      columns[k] = interpolate({v[j == 0 ? 1 : j - 1], v[j], v[j + 1], v[j + 2]}, y - static_cast<double>(j));
    }
    return std::max(interpolate(columns, x - static_cast<double>(i)), 0.0);
  }

  double highest() const { return *std::max_element(values_.begin(), values_.end()); }

 private:
  double spacing_;
  std::size_t count_;
  std::vector<double> values_;
};

// Directions along the axes and in general position.
template <int Dim>
std::vector<Vec<Dim>> probe_directions() {
  std::vector<Vec<Dim>> directions;
  for (int axis = 0; axis < Dim; ++axis) {
    Vec<Dim> direction(0.0);
    direction[axis] = 1.0;
    directions.push_back(direction);
    direction = Vec<Dim>(1.0);
    direction[axis] = -0.37;
    directions.push_back(direction / length(direction));
  }
  return directions;
}

// Unit vectors across an axis of unit length; their opposites too.
template <int Dim>
std::vector<Vec<Dim>> directions_across(const Vec<Dim>& axis) {
  std::vector<Vec<Dim>> result;
  for (const Vec<Dim>& direction : probe_directions<Dim>()) {
    const Vec<Dim> across = direction - axis * dot(direction, axis);
    if (length(across) < 0.1) continue;
    result.push_back(across / length(across));
    result.push_back(-across / length(across));
  }
  return result;
}

// Whether the noise has one power at along * axis + across * (any of the directions), for pairs of along and
// across through its band.
template <int Dim>
bool is_symmetric(const Noise<Dim>& noise, const Vec<Dim>& axis, const std::vector<Vec<Dim>>& directions,
                  const std::vector<std::array<double, 2>>& pairs) {
  double highest = 0.0;
  double difference = 0.0;
  for (const auto& [along, across] : pairs) {
    double low = noise.power_spectrum(axis * along + directions[0] * across);
    double high = low;
    for (const Vec<Dim>& direction : directions) {
      const double power = noise.power_spectrum(axis * along + direction * across);
      low = std::min(low, power);
      high = std::max(high, power);
    }
    highest = std::max(highest, high);
    difference = std::max(difference, high - low);
  }
  return difference <= 1e-6 * highest;
}

template <int Dim>
bool is_isotropic(const Noise<Dim>& noise) {
  std::vector<std::array<double, 2>> pairs;
  for (int i = 1; i <= 16; ++i) pairs.push_back({0.0, noise.band().upper * i / 16.0});
  return is_symmetric(noise, Vec<Dim>(0.0), probe_directions<Dim>(), pairs);
}

template <int Dim>
bool is_axial(const Noise<Dim>& noise, const Vec<Dim>& axis) {
  std::vector<std::array<double, 2>> pairs;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 1; j <= 4; ++j)
      pairs.push_back({noise.band().upper * i / 4.0, noise.band().upper * j / 4.0});
  }
  return is_symmetric(noise, axis, directions_across(axis), pairs);
}

template <int Dim>
SpectralDensity<Dim> radial_density(const Noise<Dim>& noise, double block_length) {
  const double reach = 4.0 * noise.band().upper;
  const double spacing = 1.0 / (32.0 * block_length);
  std::vector<double> values;
  for (double f = 0.0; f < reach + 3.0 * spacing; f += spacing) {
    Vec<Dim> frequency(0.0);
    frequency[0] = f;
    values.push_back(noise.power_spectrum(frequency));
  }
  const auto table = std::make_shared<const RadialTable>(spacing, std::move(values));
  return {[table](const Vec<Dim>& frequency) { return (*table)(length(frequency)); }, reach};
}

// The largest difference between a table and a finer one, at the finer one's nodes that are new.
double largest_difference(const AxialTable& coarse, const AxialTable& fine, double spacing,
                          std::size_t count) {
  double largest = 0.0;
  for (std::size_t i = 0; i + 6 < count; ++i) {
    for (std::size_t j = 1 - i % 2; j + 6 < count; j += 2) {
      const double along = static_cast<double>(i) * spacing;
      const double across = static_cast<double>(j) * spacing;
      largest = std::max(largest, std::abs(coarse(along, across) - fine(along, across)));
    }
  }
  return largest;
}

template <int Dim>
SpectralDensity<Dim> axial_density(const Noise<Dim>& noise, const Vec<Dim>& axis) {
  const double reach = 2.0 * noise.band().upper;
  const Vec<Dim> across = directions_across(axis)[0];
  const auto power = [&](double x, double y) { return noise.power_spectrum(axis * x + across * y); };

  // The spacing is halved until that changes little; the finer table's error is some 16 times smaller yet.
  constexpr double kChange = 1e-3;
  constexpr std::size_t kMostIntervals = 384;
  std::size_t intervals = 24;
  auto table = std::make_shared<const AxialTable>(reach / 24.0, intervals + 3, power);
  while (intervals < kMostIntervals) {
    intervals *= 2;
    const double spacing = reach / static_cast<double>(intervals);
    const auto finer = std::make_shared<const AxialTable>(spacing, intervals + 3, power);
    const double change = largest_difference(*table, *finer, spacing, intervals + 3);
    table = finer;
    if (change <= kChange * table->highest()) break;
  }
  const auto density = [table, axis](const Vec<Dim>& frequency) {
    const double along = dot(frequency, axis);
    return (*table)(along, length(frequency - axis * along));
  };
  return {density, reach};
}

}  // namespace

template <int Dim>
SpectralDensity<Dim> spectral_density(const Noise<Dim>& noise, double block_length,
                                      const std::optional<Vec<Dim>>& axis) {
  if (is_isotropic(noise)) return radial_density(noise, block_length);
  if (axis && length(*axis) > 0.0) {
    const Vec<Dim> unit = *axis / length(*axis);
    if (Dim > 1 && is_axial(noise, unit)) return axial_density(noise, unit);
  }
  return {[&noise](const Vec<Dim>& frequency) { return noise.power_spectrum(frequency); },
          2.0 * noise.band().upper};
}

template SpectralDensity<1> spectral_density<1>(const Noise<1>&, double, const std::optional<Vec<1>>&);
template SpectralDensity<2> spectral_density<2>(const Noise<2>&, double, const std::optional<Vec<2>>&);
template SpectralDensity<3> spectral_density<3>(const Noise<3>&, double, const std::optional<Vec<3>>&);

}  // namespace solidnoise
