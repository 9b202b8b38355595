#include "solidnoise/analysis/exemplar/exemplar_channels.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

constexpr double kNoVariance = 1e-15;  // of that of all channels

using Complex = std::complex<double>;
using Matrix = std::array<Complex, 9>;

template <int Dim>
std::vector<Matrix> rotated_matrices(const CrossSpectra<Dim>& spectra, const AxisMatrix& axes) {
  std::vector<Matrix> result(spectra.cross.front().size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    for (std::size_t p = 0; p < 3; ++p) {
      for (std::size_t q = 0; q < 3; ++q) {
        Complex sum = 0.0;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            sum += axes[p][i] * axes[q][j] * spectra.cross[static_cast<std::size_t>(3 * i + j)][k];
          }
        }
        result[k][3 * p + q] = sum;
      }
    }
  }
  return result;
}

// Divides the matrix of each frequency by the mean trace of those in its ring, of .05 cycles per sample, to
// some power.
template <int Dim>
void even_out(std::vector<Matrix>& matrices, const CrossSpectra<Dim>& spectra, double power) {
  constexpr double kWidth = 0.05;
  struct Ring {
    double trace = 0.0;
    double count = 0.0;
  };
  PowerSpectrum<Dim> frequencies;
  frequencies.count = spectra.count;
  frequencies.step = Vec<Dim>(1.0);
  std::vector<Ring> rings(static_cast<std::size_t>(std::sqrt(Dim) * 0.5 / kWidth) + 1);
  const auto ring_of = [&](std::size_t k) -> Ring& {
    return rings[static_cast<std::size_t>(glm::length(frequencies.frequency(k)) / kWidth)];
  };
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    Ring& ring = ring_of(k);
    for (std::size_t i = 0; i < 9; i += 4) ring.trace += matrices[k][i].real();
    ring.count += 1.0;
  }
  for (std::size_t k = 0; k < matrices.size(); ++k) {
    const Ring& ring = ring_of(k);
    const double factor = ring.trace > 0.0 ? std::pow(ring.count / ring.trace, power) : 0.0;
    for (Complex& element : matrices[k]) element *= factor;
  }
}

// Turns rows and columns p and q of all matrices by an angle, and the axes with them.
void rotate(std::vector<Matrix>& matrices, AxisMatrix& axes, std::size_t p, std::size_t q, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (Matrix& m : matrices) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Complex at_p = m[3 * p + j];
      const Complex at_q = m[3 * q + j];
      m[3 * p + j] = c * at_p + s * at_q;
      m[3 * q + j] = c * at_q - s * at_p;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Complex at_p = m[3 * i + p];
      const Complex at_q = m[3 * i + q];
      m[3 * i + p] = c * at_p + s * at_q;
      m[3 * i + q] = c * at_q - s * at_p;
    }
  }
  const Vec<3> axis = axes[p];
  axes[p] = c * axis + s * axes[q];
  axes[q] = c * axes[q] - s * axis;
}

// The rotation of axes p and q that leaves the least off the diagonals of all matrices: by the principal
// direction (x, y) of the vectors (m_pp - m_qq, m_pq + m_qp), with the double angle between it and (1, 0).
double best_angle(const std::vector<Matrix>& matrices, std::size_t p, std::size_t q) {
  double along = 0.0;
  double across = 0.0;
  double mixed = 0.0;
  for (const Matrix& m : matrices) {
    const Complex difference = m[3 * p + p] - m[3 * q + q];
    const Complex sum = m[3 * p + q] + m[3 * q + p];
    along += std::norm(difference);
    across += std::norm(sum);
    mixed += (std::conj(difference) * sum).real();
  }
  // The principal direction is at half the angle of (along - across, 2 mixed); rotate by half of that again.
  return 0.25 * std::atan2(2.0 * mixed, along - across);
}

// Turns the first `live` axes among each other.
void diagonalize_jointly(std::vector<Matrix>& matrices, AxisMatrix& axes, std::size_t live) {
  constexpr int kSweeps = 50;
  constexpr double kStill = 1e-9;  // radians
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double largest = 0.0;
    for (std::size_t p = 0; p < live; ++p) {
      for (std::size_t q = p + 1; q < live; ++q) {
        const double angle = best_angle(matrices, p, q);
        rotate(matrices, axes, p, q, angle);
        largest = std::max(largest, std::abs(angle));
      }
    }
    if (largest < kStill) return;
  }
}

// Principal axes, each as long as the standard deviation along it, the longest first.
template <int Dim>
AxisMatrix principal_axes(const CrossSpectra<Dim>& spectra) {
  const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(spectra.covariance.data());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const double least = 0.1 * kNoVariance * covariance.trace();  // colours may lie in a plane
  AxisMatrix result;
  for (int k = 0; k < 3; ++k) {
    const double length = std::sqrt(std::max(solver.eigenvalues()(2 - k), least));
    for (int i = 0; i < 3; ++i) {
      result[static_cast<std::size_t>(k)][i] = length * solver.eigenvectors()(i, 2 - k);
    }
  }
  return result;
}

// How many of these are of a colour that varies: of colours on a line, or in a plane, there are 1 or 2.
std::size_t live_axes(const AxisMatrix& principal) {
  const auto variance = [&](std::size_t k) { return glm::dot(principal[k], principal[k]); };
  const double total = variance(0) + variance(1) + variance(2);
  std::size_t live = 0;
  while (live < 3 && variance(live) > kNoVariance * total) ++live;
  return live;
}

// Axes of the joint diagonalisation of all frequencies, where each ring of them weighs as much as the next,
// as far as that leaves channels no more dependent than along the principal axes; else as its power asks for.
template <int Dim>
AxisMatrix independent_axes(const CrossSpectra<Dim>& spectra, const AxisMatrix& principal) {
  const double most = channel_dependence(spectra, channel_directions(principal));
  AxisMatrix axes;
  for (const double power : {1.0, 0.5, 0.0}) {
    std::vector<Matrix> matrices = rotated_matrices(spectra, channel_directions(principal));
    even_out(matrices, spectra, power);
    axes = principal;
    diagonalize_jointly(matrices, axes, live_axes(principal));
    if (channel_dependence(spectra, channel_directions(axes)) <= most) break;
  }
  return axes;
}

}  // namespace

AxisMatrix channel_directions(const AxisMatrix& axes) {
  Eigen::Matrix3d columns;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) columns(i, k) = axes[static_cast<std::size_t>(k)][i];
  }
  const Eigen::Matrix3d rows = columns.inverse();
  AxisMatrix directions;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) directions[static_cast<std::size_t>(k)][i] = rows(k, i);
  }
  return directions;
}

template <int Dim>
AxisMatrix color_axes(const CrossSpectra<Dim>& spectra, ColorAxes kind) {
  AxisMatrix axes{Vec<3>(1.0, 0.0, 0.0), Vec<3>(0.0, 1.0, 0.0), Vec<3>(0.0, 0.0, 1.0)};
  if (kind == ColorAxes::rgb) return axes;
  axes = principal_axes(spectra);
  if (kind == ColorAxes::independent) axes = independent_axes(spectra, axes);
  for (Vec<3>& axis : axes) {
    if (axis.x + axis.y + axis.z < 0.0) axis = -axis;
  }
  std::stable_sort(axes.begin(), axes.end(),
                   [&](const Vec<3>& a, const Vec<3>& b) { return glm::dot(a, a) > glm::dot(b, b); });
  for (Vec<3>& axis : axes) axis = glm::normalize(axis);
  return axes;
}

template <int Dim>
double channel_dependence(const CrossSpectra<Dim>& spectra, const AxisMatrix& directions) {
  std::array<double, 3> variance{};
  for (std::size_t k = 0; k < 3; ++k) {
    variance[k] = spectra.variance(std::array{directions[k].x, directions[k].y, directions[k].z});
  }
  const double total = variance[0] + variance[1] + variance[2];
  double off = 0.0;
  double all = 0.0;
  for (const Matrix& m : rotated_matrices(spectra, directions)) {
    for (std::size_t i = 0; i < 9; ++i) {
      // Channels of nothing depend on nothing.
      if (std::min(variance[i / 3], variance[i % 3]) <= kNoVariance * total) continue;
      const double scale = variance[i / 3] * variance[i % 3];
      all += std::norm(m[i]) / scale;
      if (i % 4 != 0) off += std::norm(m[i]) / scale;
    }
  }
  return off / all;
}

double ExemplarChannels::total_variance() const {
  double sum = 0.0;
  for (const double variance : variances) sum += variance;
  return sum;
}

bool ExemplarChannels::is_empty(std::size_t channel) const {
  return !(variances[channel] > kNoVariance * total_variance());
}

GaborSpectrum ExemplarChannels::empty_spectrum(int dimensions, double sample_step) const {
  GaborSpectrum spectrum;
  spectrum.dimensions = dimensions;
  SpectrumComponent component;
  component.variance = kNoVariance * total_variance();
  spectrum.bands = {{0.25 / sample_step, {component}}};
  return spectrum;
}

template <int Dim>
ExemplarChannels exemplar_channels(const CrossSpectra<Dim>& spectra, ColorAxes kind) {
  ExemplarChannels result;
  if (spectra.channels == 1) {
    result.mean = Vec<3>(spectra.mean[0]);
    result.axes = {Vec<3>(1.0)};
    result.directions = {{1.0}};
  } else {
    result.mean = Vec<3>(spectra.mean[0], spectra.mean[1], spectra.mean[2]);
    const AxisMatrix axes = color_axes(spectra, kind);
    result.axes.assign(axes.begin(), axes.end());
    for (const Vec<3>& direction : channel_directions(axes)) {
      result.directions.push_back({direction.x, direction.y, direction.z});
    }
    const auto dependence = [&](ColorAxes other) {
      return channel_dependence(spectra, channel_directions(color_axes(spectra, other)));
    };
    result.dependence = {dependence(ColorAxes::rgb), dependence(ColorAxes::pca),
                         dependence(ColorAxes::independent)};
  }
  for (const std::vector<double>& direction : result.directions) {
    result.variances.push_back(spectra.variance(direction));
  }
  const auto samples = static_cast<double>(spectra.cross.front().size());
  for (std::size_t i = 0; i < spectra.cross.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 1; k < spectra.cross[i].size(); ++k) sum += spectra.cross[i][k].real();
    result.trends.push_back(spectra.covariance[i] - sum / samples);
  }
  return result;
}

template AxisMatrix color_axes<2>(const CrossSpectra<2>&, ColorAxes);
template AxisMatrix color_axes<3>(const CrossSpectra<3>&, ColorAxes);
template double channel_dependence<2>(const CrossSpectra<2>&, const AxisMatrix&);
template double channel_dependence<3>(const CrossSpectra<3>&, const AxisMatrix&);
template ExemplarChannels exemplar_channels<2>(const CrossSpectra<2>&, ColorAxes);
template ExemplarChannels exemplar_channels<3>(const CrossSpectra<3>&, ColorAxes);

}  // namespace solidnoise
