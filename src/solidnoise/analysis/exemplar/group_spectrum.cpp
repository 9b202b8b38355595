#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "solidnoise/analysis/exemplar/edit_spectrum.h"

namespace solidnoise {
namespace {

constexpr double kPeakShare = 0.005;   // of the variance: what a periodic component has at least
constexpr double kPeakHeight = 8.0;    // and its height over the density of all others there
constexpr double kPeakDistance = 3.0;  // and its distance from frequency 0, in a's
constexpr int kWedges = 36;            // of 5 degrees
constexpr double kWedgeExcess = 2.0;   // power of an anisotropic direction against the mean of all
constexpr double kWedgeShare = 0.05;   // and its share of the variance

// Heights of the components' Gaussians.
double height(const SpectrumBand& band, const SpectrumComponent& component, int dimensions) {
  return 0.5 * component.variance * std::pow(std::numbers::sqrt2 / band.a, dimensions);
}

bool is_periodic(const GaborSpectrum& spectrum, const SpectrumBand& band, const SpectrumComponent& component,
                 double total) {
  if (component.variance < kPeakShare * total) return false;
  if (glm::length(component.frequency) < kPeakDistance * band.a) return false;
  const double own = height(band, component, spectrum.dimensions);
  return own > kPeakHeight * std::max(0.0, spectrum.density(component.frequency) - own);
}

// The wedge of directions, opposite ones taken as one, that a component lies in; -1 near frequency 0.
int wedge_of(const SpectrumBand& band, const SpectrumComponent& component) {
  const Vec<3>& w = component.frequency;
  if (glm::length(w) < band.a) return -1;
  double turn = std::atan2(w.y, w.x) / std::numbers::pi;
  turn -= std::floor(turn);
  return std::min(kWedges - 1, static_cast<int>(turn * kWedges));
}

// The group of each wedge, counted from 0; -1 for those that have no more than others.
std::array<int, kWedges> anisotropic_wedges(const GaborSpectrum& spectrum, int& groups) {
  std::array<double, kWedges> power{};
  double all = 0.0;
  for (const SpectrumBand& band : spectrum.bands) {
    for (const SpectrumComponent& component : band.components) {
      const int wedge = wedge_of(band, component);
      if (wedge < 0 || component.group != 0) continue;
      power[static_cast<std::size_t>(wedge)] += component.variance;
      all += component.variance;
    }
  }
  // A component's own width spreads over some wedges: smooth over three.
  std::array<bool, kWedges> above{};
  for (std::size_t i = 0; i < kWedges; ++i) {
    const double around = power[(i + kWedges - 1) % kWedges] + power[i] + power[(i + 1) % kWedges];
    above[i] = around > 3.0 * kWedgeExcess * all / kWedges;
  }
  std::array<int, kWedges> group;
  group.fill(-1);
  groups = 0;
  const auto start = static_cast<std::size_t>(std::find(above.begin(), above.end(), false) - above.begin());
  if (start == kWedges) return group;
  for (std::size_t i = 1; i <= kWedges;) {
    std::vector<std::size_t> run;
    double share = 0.0;
    for (; i <= kWedges && above[(start + i) % kWedges]; ++i) {
      run.push_back((start + i) % kWedges);
      share += power[run.back()];
    }
    if (!run.empty() && share > kWedgeShare * spectrum.variance()) {
      for (const std::size_t wedge : run) group[wedge] = groups;
      ++groups;
    }
    ++i;
  }
  return group;
}

// Drops groups without components and numbers the others anew.
void drop_empty_groups(GaborSpectrum& spectrum) {
  std::vector<int> count(spectrum.groups.size(), 0);
  for (const SpectrumBand& band : spectrum.bands) {
    for (const SpectrumComponent& component : band.components) {
      ++count[static_cast<std::size_t>(component.group)];
    }
  }
  std::vector<int> number(count.size(), 0);
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < count.size(); ++i) {
    number[i] = static_cast<int>(kept.size());
    if (count[i] > 0) kept.push_back(spectrum.groups[i]);
  }
  spectrum.groups = kept;
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) {
      component.group = number[static_cast<std::size_t>(component.group)];
    }
  }
}

}  // namespace

GaborSpectrum group_spectrum(GaborSpectrum spectrum) {
  spectrum.groups = {"stochastic", "periodic"};
  const double total = spectrum.variance();
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) {
      component.group = is_periodic(spectrum, band, component, total) ? 1 : 0;
    }
  }
  if (!spectrum.isotropic && spectrum.dimensions == 2) {
    int groups = 0;
    const std::array<int, kWedges> wedges = anisotropic_wedges(spectrum, groups);
    for (int i = 0; i < groups; ++i) {
      spectrum.groups.push_back(i == 0 ? "anisotropic" : "anisotropic " + std::to_string(i + 1));
    }
    for (SpectrumBand& band : spectrum.bands) {
      for (SpectrumComponent& component : band.components) {
        const int wedge = wedge_of(band, component);
        if (component.group != 0 || wedge < 0) continue;
        const int group = wedges[static_cast<std::size_t>(wedge)];
        if (group >= 0) component.group = 2 + group;
      }
    }
  }
  drop_empty_groups(spectrum);
  return spectrum;
}

}  // namespace solidnoise
