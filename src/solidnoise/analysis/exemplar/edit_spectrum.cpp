#include "solidnoise/analysis/exemplar/edit_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "solidnoise/core/check.h"

namespace solidnoise {
namespace {

constexpr double kSameBandwidth = 1e-9;  // relative
constexpr Interval kFactors = between(1e-9, 1e9);

void require_directions(const GaborSpectrum& spectrum, std::string_view what) {
  if (!spectrum.isotropic) return;
  throw std::invalid_argument(fmt::format("an isotropic spectrum cannot be {}; it has no directions", what));
}

// Runs edit(component) on those of the group; the spectrum changes only if the result is valid.
template <typename Edit>
void edit_components(GaborSpectrum& spectrum, const GroupChoice& group, const Edit& edit) {
  const int number = group ? find_group(spectrum, *group) : -1;
  GaborSpectrum result = spectrum;
  for (SpectrumBand& band : result.bands) {
    for (SpectrumComponent& component : band.components) {
      if (number < 0 || component.group == number) edit(component);
    }
  }
  result.validate();
  spectrum = std::move(result);
}

void drop_empty_bands(GaborSpectrum& spectrum) {
  std::erase_if(spectrum.bands, [](const SpectrumBand& band) { return band.components.empty(); });
}

SpectrumBand& band_with(GaborSpectrum& spectrum, double a) {
  for (SpectrumBand& band : spectrum.bands) {
    if (std::abs(band.a - a) <= kSameBandwidth * a) return band;
  }
  return spectrum.bands.emplace_back(SpectrumBand{a, {}});
}

int group_with(GaborSpectrum& spectrum, const std::string& name) {
  const auto found = std::find(spectrum.groups.begin(), spectrum.groups.end(), name);
  if (found == spectrum.groups.end()) {
    spectrum.groups.push_back(name);
    return static_cast<int>(spectrum.groups.size()) - 1;
  }
  return static_cast<int>(found - spectrum.groups.begin());
}

// Takes a number out of the groups, whose components must be gone.
void drop_group(GaborSpectrum& spectrum, int number) {
  spectrum.groups.erase(spectrum.groups.begin() + number);
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) {
      if (component.group > number) --component.group;
    }
  }
}

}  // namespace

int find_group(const GaborSpectrum& spectrum, const std::string& name) {
  const auto found = std::find(spectrum.groups.begin(), spectrum.groups.end(), name);
  if (found != spectrum.groups.end()) return static_cast<int>(found - spectrum.groups.begin());
  throw std::invalid_argument(
      fmt::format("there is no group {}; there are {}", name, fmt::join(spectrum.groups, ", ")));
}

void rotate_group(GaborSpectrum& spectrum, const GroupChoice& group, double degrees, const Vec<3>& axis) {
  require_finite("degrees", degrees);
  require_directions(spectrum, "rotated");
  if (!(glm::length(axis) > 0.0)) throw std::invalid_argument("the axis of a rotation has no length");
  const Vec<3> k = spectrum.dimensions == 2 ? Vec<3>(0.0, 0.0, 1.0) : glm::normalize(axis);
  const double angle = degrees * std::numbers::pi / 180.0;
  edit_components(spectrum, group, [&](SpectrumComponent& component) {
    // Rodrigues' formula.
    const Vec<3>& w = component.frequency;
    component.frequency = std::cos(angle) * w + std::sin(angle) * glm::cross(k, w) +
                          (1.0 - std::cos(angle)) * glm::dot(k, w) * k;
    if (spectrum.dimensions == 2) component.frequency.z = 0.0;
  });
}

void scale_group(GaborSpectrum& spectrum, const GroupChoice& group, double factor) {
  require("scale", factor, kFactors);
  edit_components(spectrum, group, [&](SpectrumComponent& component) { component.frequency *= factor; });
}

void translate_group(GaborSpectrum& spectrum, const GroupChoice& group, const Vec<3>& by) {
  require_directions(spectrum, "translated");
  edit_components(spectrum, group, [&](SpectrumComponent& component) { component.frequency += by; });
}

void scale_magnitude(GaborSpectrum& spectrum, const GroupChoice& group, double factor) {
  if (factor != 0.0) require("magnitude", factor, kFactors);
  edit_components(spectrum, group,
                  [&](SpectrumComponent& component) { component.variance *= factor * factor; });
}

void scale_bandwidth(GaborSpectrum& spectrum, const GroupChoice& group, double factor) {
  require("bandwidth", factor, kFactors);
  const int number = group ? find_group(spectrum, *group) : -1;
  GaborSpectrum result = spectrum;
  std::vector<SpectrumBand> moved;
  for (SpectrumBand& band : result.bands) {
    SpectrumBand& wider = moved.emplace_back(SpectrumBand{band.a * factor, {}});
    for (const SpectrumComponent& component : band.components) {
      if (number < 0 || component.group == number) wider.components.push_back(component);
    }
    std::erase_if(band.components,
                  [&](const SpectrumComponent& c) { return number < 0 || c.group == number; });
  }
  drop_empty_bands(result);
  for (const SpectrumBand& band : moved) {
    if (band.components.empty()) continue;
    std::vector<SpectrumComponent>& into = band_with(result, band.a).components;
    into.insert(into.end(), band.components.begin(), band.components.end());
  }
  result.validate();
  spectrum = std::move(result);
}

void remove_group(GaborSpectrum& spectrum, const std::string& group) {
  const int number = find_group(spectrum, group);
  GaborSpectrum result = spectrum;
  for (SpectrumBand& band : result.bands) {
    std::erase_if(band.components, [&](const SpectrumComponent& c) { return c.group == number; });
  }
  drop_empty_bands(result);
  if (result.groups.size() > 1) drop_group(result, number);
  result.validate();
  spectrum = std::move(result);
}

void add_component(GaborSpectrum& spectrum, double a, SpectrumComponent component, const std::string& group) {
  require_positive("a", a, "cycles per world unit");
  GaborSpectrum result = spectrum;
  component.group = group_with(result, group);
  band_with(result, a).components.push_back(component);
  result.validate();
  spectrum = std::move(result);
}

void copy_group(GaborSpectrum& spectrum, const GaborSpectrum& from, const GroupChoice& group) {
  if (from.dimensions != spectrum.dimensions || from.isotropic != spectrum.isotropic) {
    throw std::invalid_argument("the two spectra are of different kinds");
  }
  const int number = group ? find_group(from, *group) : -1;
  GaborSpectrum result = spectrum;
  for (const SpectrumBand& band : from.bands) {
    for (SpectrumComponent component : band.components) {
      if (number >= 0 && component.group != number) continue;
      component.group = group_with(result, from.groups[static_cast<std::size_t>(component.group)]);
      band_with(result, band.a).components.push_back(component);
    }
  }
  result.validate();
  spectrum = std::move(result);
}

int select_group(GaborSpectrum& spectrum, const GroupChoice& within, const ComponentSelection& selection,
                 const std::string& name) {
  require_at_least("the lowest frequency", selection.from, 0.0, "cycles per unit");
  if (!(selection.to > selection.from)) {
    throw std::invalid_argument(fmt::format("the highest frequency is {}; it must be above the lowest, {}",
                                            selection.to, selection.from));
  }
  require_finite("the direction", selection.direction);
  require_in_range("the spread of directions", selection.spread, 0.0, 180.0, "degrees");
  const bool by_direction = selection.spread < 90.0;
  if (by_direction && spectrum.dimensions != 2) {
    throw std::invalid_argument("components of three dimensions are selected by frequency alone");
  }
  if (by_direction) require_directions(spectrum, "selected by direction");
  const int number = within ? find_group(spectrum, *within) : -1;
  const auto is_selected = [&](const SpectrumComponent& component) {
    const double length = glm::length(component.frequency);
    if (number >= 0 && component.group != number) return false;
    if (length < selection.from || length >= selection.to) return false;
    if (!by_direction) return true;
    const double angle = glm::degrees(std::atan2(component.frequency.y, component.frequency.x));
    return std::abs(std::remainder(angle - selection.direction, 180.0)) <= selection.spread;
  };
  GaborSpectrum result = spectrum;
  const int group = group_with(result, name);
  int count = 0;
  for (SpectrumBand& band : result.bands) {
    for (SpectrumComponent& component : band.components) {
      if (!is_selected(component)) continue;
      component.group = group;
      ++count;
    }
  }
  spectrum = std::move(result);
  return count;
}

void rename_group(GaborSpectrum& spectrum, const std::string& group, const std::string& name) {
  const int number = find_group(spectrum, group);
  const auto existing = std::find(spectrum.groups.begin(), spectrum.groups.end(), name);
  if (existing == spectrum.groups.end()) {
    spectrum.groups[static_cast<std::size_t>(number)] = name;
    return;
  }
  const int into = static_cast<int>(existing - spectrum.groups.begin());
  if (into == number) return;
  for (SpectrumBand& band : spectrum.bands) {
    for (SpectrumComponent& component : band.components) {
      if (component.group == number) component.group = into;
    }
  }
  drop_group(spectrum, number);
}

}  // namespace solidnoise
