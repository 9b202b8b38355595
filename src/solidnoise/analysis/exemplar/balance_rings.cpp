#include "solidnoise/analysis/exemplar/balance_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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
std::vector<double> wanted_powers(const std::vector<std::vector<double>>& cross,
                                  const std::vector<double>& trends, const Probe& probe) {
  std::vector<double> wanted;
  double seen = 0.0;
  for (const std::vector<double>& ring : cross) seen += wanted.emplace_back(power_of(probe, ring));
  const double hidden = std::clamp(probe.all - seen, 0.0, std::max(power_of(probe, trends), 0.0));
  for (double& power : wanted) power *= seen > 0.0 ? (probe.all - hidden) / seen : 1.0;
  wanted.front() += hidden;
  for (double& power : wanted) power = std::max(power, kLeast * probe.all);
  return wanted;
}

}  // namespace

std::vector<std::vector<double>> balance_rings(const std::vector<std::vector<double>>& cross,
                                               const ExemplarChannels& channels) {
  const std::vector<Probe> probes = probes_of(channels);
  std::vector<std::vector<double>> wanted;
  for (const Probe& probe : probes) wanted.push_back(wanted_powers(cross, channels.trends, probe));
  std::vector<std::vector<double>> powers;  // of each channel
  for (const double variance : channels.variances)
    powers.emplace_back(cross.size(), variance / static_cast<double>(cross.size()));

  // Each power is multiplied by the root of the ratio of the two parts of the sum's derivative by it.
  const std::size_t count = powers.size();
  for (int round = 0; round < kBalancingRounds; ++round) {
    std::vector<double> sums(count);
    for (std::size_t r = 0; r < cross.size(); ++r) {
      std::array<double, 3> more{};
      std::array<double, 3> less{};
      for (std::size_t p = 0; p < probes.size(); ++p) {
        std::array<double, 3> gains{};
        double made = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
          gains[k] = probes[p].gain(channels.axes[k]);
          made += gains[k] * powers[k][r];
        }
        for (std::size_t k = 0; k < count; ++k) {
          more[k] += probes[p].weight * gains[k] * wanted[p][r] / (made * made);
          less[k] += probes[p].weight * gains[k] / wanted[p][r];
        }
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (powers[k][r] > 0.0) powers[k][r] *= std::sqrt(more[k] / less[k]);
        sums[k] += powers[k][r];
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      for (double& power : powers[k]) power *= sums[k] > 0.0 ? channels.variances[k] / sums[k] : 0.0;
    }
  }
  return powers;
}

}  // namespace solidnoise
