#include "solidnoise/analysis/exemplar/square_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>

#include "solidnoise/analysis/exemplar/gaussian_field.h"

namespace solidnoise {
namespace {

// The symmetric matrix with the same eigenvectors, and as eigenvalues powers of those that are above 0.
Eigen::Matrix3d matrix_power(const Eigen::Matrix3d& matrix, double power) {
  constexpr double kNothing = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const double least = kNothing * solver.eigenvalues()[2];
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double value = solver.eigenvalues()[i];
    if (value > least) values[i] = std::pow(value, power);
  }
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

// The nearest that noise can have: without negative eigenvalues, and with the variances that it had.
Eigen::Matrix3d with_own_variances(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix3d positive = matrix_power(matrix, 1.0);
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (positive(i, i) > 0.0) scale[i] = std::sqrt(matrix(i, i) / positive(i, i));
  }
  return scale.asDiagonal() * positive * scale.asDiagonal();
}

// Of the colours before they are squared.
Eigen::Matrix3d covariance_of(const ExemplarModel& model) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    const Eigen::Vector3d axis(model.axes[k].x, model.axes[k].y, model.axes[k].z);
    sum += model.channels[k].variance() * axis * axis.transpose();
  }
  return sum;
}

}  // namespace

template <int Dim>
std::vector<Exemplar<Dim>> square_roots(std::span<const Exemplar<Dim>> exemplars) {
  std::vector<Exemplar<Dim>> roots(exemplars.begin(), exemplars.end());
  for (Exemplar<Dim>& exemplar : roots) {
    for (DenseField<Dim>& channel : exemplar.channels) {
      for (float& value : channel.values) value = std::sqrt(std::max(value, 0.0f));
    }
  }
  return roots;
}

Exemplar<2> squared(Exemplar<2> exemplar) {
  for (DenseField<2>& channel : exemplar.channels) {
    for (float& value : channel.values) value *= value;
  }
  return exemplar;
}

Exemplar<2> squared_version(const Exemplar<2>& exemplar, std::uint64_t seed) {
  return squared(gaussian_version(square_roots(std::span(&exemplar, 1)).front(), seed));
}

double reached_share(double mean, double variance) {
  const double most = 2.0 * mean * mean;
  return variance > most ? most / variance : 1.0;
}

RootMoments root_moments(double mean, double variance) {
  if (!(mean > 0.0)) return {};
  const double square = std::sqrt(std::max(mean * mean - 0.5 * variance, 0.0));  // m^2
  return {std::sqrt(square), mean - square};
}

void square_colors(ExemplarModel& model, const SampleMoments& wanted) {
  const std::size_t colors = wanted.mean.size();
  const auto channel = [&](int i) { return colors == 1 ? 0 : static_cast<std::size_t>(i); };
  Eigen::Vector3d mean;
  Eigen::Vector3d share;  // of the deviation that is wanted
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) {
    const std::size_t c = channel(i);
    const double variance = wanted.covariance[c * colors + c];
    const RootMoments root = root_moments(wanted.mean[c], variance);
    model.mean[i] = mean[i] = root.mean;
    share[i] = std::sqrt(reached_share(wanted.mean[c], variance));
    covariance(i, i) = root.variance;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      const double of_squares = share[i] * share[j] * wanted.covariance[channel(i) * colors + channel(j)];
      const double product = mean[i] * mean[j];
      covariance(i, j) = std::sqrt(std::max(product * product + 0.5 * of_squares, 0.0)) - product;
    }
  }
  const Eigen::Matrix3d change =
      matrix_power(with_own_variances(covariance), 0.5) * matrix_power(covariance_of(model), -0.5);
  for (Vec<3>& axis : model.axes) {
    const Eigen::Vector3d moved = change * Eigen::Vector3d(axis.x, axis.y, axis.z);
    axis = Vec<3>(moved[0], moved[1], moved[2]);
  }
  model.squares = true;
}

template std::vector<Exemplar<2>> square_roots<2>(std::span<const Exemplar<2>>);
template std::vector<Exemplar<3>> square_roots<3>(std::span<const Exemplar<3>>);

}  // namespace solidnoise
