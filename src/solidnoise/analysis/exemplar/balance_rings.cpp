#include "solidnoise/analysis/exemplar/balance_rings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

constexpr int kBalancingRounds = 200;
constexpr double kLeast = 1e-12;  // power that is wanted, in that of all rings: of what there is nothing of

// A linear function of colour, whose power is held to.
struct Probe {
  Vec<3> color;
  double weight;
  double least;      // power in a ring that an eye might see, in the colours' there
  double all = 0.0;  // power in all rings

  double gain(const Vec<3>& axis) const { return std::pow(glm::dot(color, axis), 2); }
};

// Those that there is any power of.
std::vector<Probe> probes_of(const ExemplarChannels& channels) {
  std::vector<Probe> probes{{{1.0, 0.0, 0.0}, 1.0, 0.0}};
  if (channels.axes.size() == 3) {
    probes = {{{1.0, 0.0, 0.0}, 1.0, 0.0},   {{0.0, 1.0, 0.0}, 1.0, 0.0},
              {{0.0, 0.0, 1.0}, 1.0, 0.0},   {{0.2126, 0.7152, 0.0722}, 1.0, 0.0},
              {{1.0, -1.0, 0.0}, 0.2, 0.01}, {{-0.5, -0.5, 1.0}, 0.2, 0.01}};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<double>& direction = channels.directions[k];
      if (!channels.is_empty(k)) probes.push_back({{direction[0], direction[1], direction[2]}, 0.05, 0.0});
    }
  }
  for (Probe& probe : probes) {
    for (std::size_t k = 0; k < channels.axes.size(); ++k)
      probe.all += channels.variances[k] * probe.gain(channels.axes[k]);
  }
  std::erase_if(probes, [](const Probe& probe) { return !(probe.all > 0.0); });
  return probes;
}

// The power of a probe in colours of a covariance.
double power_of(const Probe& probe, const std::vector<double>& covariance) {
  const std::size_t colors = covariance.size() == 1 ? 1 : 3;
  double power = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < colors; ++i) {
    const double of_row = probe.color[static_cast<int>(i)];
    for (std::size_t j = 0; j < colors; ++j)
      power += of_row * probe.color[static_cast<int>(j)] * covariance[i * colors + j];
    mean += covariance[i * colors + i] / static_cast<double>(colors);
  }
  return std::max(power, probe.least * mean);
}

// The power of a probe in each ring.
Eigen::ArrayXd wanted_powers(const std::vector<std::vector<double>>& cross, const std::vector<double>& trends,
                             const Probe& probe) {
  Eigen::ArrayXd wanted(static_cast<Eigen::Index>(cross.size()));
  for (std::size_t r = 0; r < cross.size(); ++r)
    wanted[static_cast<Eigen::Index>(r)] = power_of(probe, cross[r]);
  const double seen = wanted.sum();
  const double hidden = std::clamp(probe.all - seen, 0.0, std::max(power_of(probe, trends), 0.0));
  if (seen > 0.0) wanted *= (probe.all - hidden) / seen;
  wanted[0] += hidden;
  return wanted.max(kLeast * probe.all);
}

}  // namespace

std::vector<std::vector<double>> balance_rings(const std::vector<std::vector<double>>& cross,
                                               const ExemplarChannels& channels) {
  const std::vector<Probe> probes = probes_of(channels);
  const auto rings = static_cast<Eigen::Index>(cross.size());
  const auto count = static_cast<Eigen::Index>(channels.axes.size());
  Eigen::VectorXd variances(count);
  for (Eigen::Index k = 0; k < count; ++k) variances[k] = channels.variances[static_cast<std::size_t>(k)];
  Eigen::MatrixXd gains(probes.size(), count);  // of a channel's power, in a probe's
  Eigen::ArrayXXd wanted(rings, probes.size());
  Eigen::ArrayXXd weights(rings, probes.size());
  for (Eigen::Index p = 0; p < wanted.cols(); ++p) {
    const Probe& probe = probes[static_cast<std::size_t>(p)];
    for (Eigen::Index k = 0; k < count; ++k)
      gains(p, k) = probe.gain(channels.axes[static_cast<std::size_t>(k)]);
    wanted.col(p) = wanted_powers(cross, channels.trends, probe);
    weights.col(p) = probe.weight;
  }

  // Each power is multiplied by the root of the ratio of the two parts of the sum's derivative by it.
  Eigen::MatrixXd powers =
      Eigen::VectorXd::Constant(rings, 1.0 / static_cast<double>(rings)) * variances.transpose();
  for (int round = 0; round < kBalancingRounds; ++round) {
    const Eigen::ArrayXXd made = (powers * gains.transpose()).array();
    const Eigen::MatrixXd more = (weights * wanted / made.square()).matrix() * gains;
    const Eigen::MatrixXd less = (weights / wanted).matrix() * gains;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (!(variances[k] > 0.0)) continue;
      powers.col(k).array() *= (more.col(k).array() / less.col(k).array()).sqrt();
      powers.col(k) *= variances[k] / powers.col(k).sum();
    }
  }
  std::vector<std::vector<double>> result;
  for (Eigen::Index k = 0; k < count; ++k)
    result.emplace_back(powers.col(k).data(), powers.col(k).data() + rings);
  return result;
}

}  // namespace solidnoise
