#include "solidnoise/analysis/exemplar/describe_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace solidnoise {
namespace {

std::string color(const Vec<3>& value) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", value.x, value.y, value.z);
}

int component_count(const GaborSpectrum& spectrum) {
  std::size_t count = 0;
  for (const SpectrumBand& band : spectrum.bands) count += band.components.size();
  return static_cast<int>(count);
}

std::string describe_groups(const GaborSpectrum& spectrum) {
  std::vector<int> counts(spectrum.groups.size(), 0);
  std::vector<double> variances(spectrum.groups.size(), 0.0);
  for (const SpectrumBand& band : spectrum.bands) {
    for (const SpectrumComponent& component : band.components) {
      ++counts[static_cast<std::size_t>(component.group)];
      variances[static_cast<std::size_t>(component.group)] += component.variance;
    }
  }
  std::string text;
  const double total = spectrum.variance();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    text += fmt::format("    group {}: {} components, {:.3g} % of the variance\n", spectrum.groups[i],
                        counts[i], 100.0 * variances[i] / total);
  }
  return text;
}

std::string describe(const ColorDependence& dependence) {
  return fmt::format("dependence of the channels J: rgb {:.3g}, pca {:.3g}, independent {:.3g}\n",
                     dependence.rgb, dependence.pca, dependence.independent);
}

template <int Dim>
std::string describe_channels(const ExemplarFit<Dim>& fit, const std::string& size, double seconds) {
  std::string text =
      fmt::format("{}, {} patch{}, {:.2f} s\n", size, fit.patches, fit.patches == 1 ? "" : "es", seconds);
  if (fit.dependence) text += describe(*fit.dependence);
  for (std::size_t k = 0; k < fit.channels.size(); ++k) {
    const SpectrumFit& channel = fit.channels[k];
    text += fmt::format(
        "  channel {}: deviation {:.4g}, {} components ({:.2f} %), residual {:.3g}, kept {:.3g} of the "
        "variance, {} iterations, gap {:.2g}, kappa {:.3g}\n",
        k, std::sqrt(channel.spectrum.variance()), channel.components, 100.0 * channel.sparseness,
        channel.residual, channel.kept_variance, channel.iterations, channel.gap, channel.kappa);
  }
  return text;
}

}  // namespace

std::string describe(const ExemplarModel& model) {
  const GaborSpectrum& first = model.channels.front();
  std::string text = fmt::format("{} channel{}, {}D{}, mean {}{}\n", model.channels.size(),
                                 model.channels.size() == 1 ? "" : "s", first.dimensions,
                                 first.isotropic ? " isotropic" : "", color(model.mean_color()),
                                 model.raw_values ? ", raw values" : ", linear light");
  if (model.squares)
    text += fmt::format("  colours are squares; of their roots, of mean {}:\n", color(model.mean));
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    const GaborSpectrum& spectrum = model.channels[k];
    text += fmt::format("  channel {}: axis {}, deviation {:.4g}, {} components in {} bands\n", k,
                        color(model.axes[k]), std::sqrt(spectrum.variance()), component_count(spectrum),
                        spectrum.bands.size());
    for (const SpectrumBand& band : spectrum.bands) {
      double variance = 0.0;
      double highest = 0.0;
      for (const SpectrumComponent& component : band.components) {
        variance += component.variance;
        highest = std::max(highest, glm::length(component.frequency));
      }
      text +=
          fmt::format("    a {:.4g}: {} components, {:.3g} % of the variance, up to {:.3g} cycles per unit\n",
                      band.a, band.components.size(), 100.0 * variance / spectrum.variance(), highest);
    }
    text += describe_groups(spectrum);
  }
  return text;
}

std::string describe(const ExemplarFit<2>& fit, double seconds) {
  return describe_channels(fit, fmt::format("{} x {} pixels", fit.count.x, fit.count.y), seconds);
}

std::string describe(const ExemplarFit<3>& fit, double seconds) {
  return describe_channels(fit, fmt::format("{} x {} x {} voxels", fit.count.x, fit.count.y, fit.count.z),
                           seconds);
}

std::string describe_shortly(const ExemplarFit<2>& fit, double seconds) {
  const SpectrumFit& first = fit.channels.front();
  return fmt::format(
      "{} x {} pixels; {} components of the first channel, {:.2f} % of the pixels; kappa 1/{:.4g}; {:.1f} s",
      fit.count.x, fit.count.y, first.components, 100.0 * first.sparseness, 1.0 / first.kappa, seconds);
}

std::string describe_shortly(const ExemplarFit<3>& fit, double seconds) {
  const SpectrumFit& spectrum = fit.channels.front();
  return fmt::format("{} x {} x {} voxels; {} components; kappa 1/{:.4g}; {:.1f} s", fit.count.x, fit.count.y,
                     fit.count.z, spectrum.components, 1.0 / spectrum.kappa, seconds);
}

std::string describe(const SolidExemplarFit& fit) {
  std::string text = fmt::format("{} x {} pixels, {} patch{}, solid noise\n", fit.count.x, fit.count.y,
                                 fit.patches, fit.patches == 1 ? "" : "es");
  if (fit.dependence) text += describe(*fit.dependence);
  for (std::size_t k = 0; k < fit.channels.size(); ++k) {
    const SolidFit& channel = fit.channels[k];
    text += fmt::format(
        "  channel {}: deviation {:.4g}, {} components, residual {:.3g}, attainable {:.3g}, "
        "anisotropy {:.2g}\n",
        k, std::sqrt(channel.spectrum.variance()), channel.components, channel.residual,
        channel.attainability, channel.anisotropy);
  }
  return text;
}

std::string describe_shortly(const SolidExemplarFit& fit) {
  const SolidFit& first = fit.channels.front();
  return fmt::format("{} x {} pixels; {} components of the first channel; residual {:.2g}, attainable {:.2g}",
                     fit.count.x, fit.count.y, first.components, first.residual, first.attainability);
}

std::vector<std::string> warnings_of(const std::vector<SpectrumFit>& channels, double gap_tolerance) {
  constexpr double kLeastKept = 0.5;
  std::vector<std::string> warnings;
  const double kept = channels.front().kept_variance;
  if (kept < kLeastKept) {
    warnings.push_back(
        fmt::format("{:.0f} % of the exemplar's variance change from side to side, as falling light does, "
                    "and become large blobs, beside which the texture is weak: even the light, or cut it",
                    100.0 * (1.0 - kept)));
  }
  for (std::size_t k = 0; k < channels.size(); ++k) {
    if (channels[k].gap <= gap_tolerance) continue;
    warnings.push_back(
        fmt::format("the spectrum of channel {} is not the best one: its gap is {:.2g}, above {:.2g}; with a "
                    "larger kappa it comes nearer",
                    k, channels[k].gap, gap_tolerance));
  }
  return warnings;
}

}  // namespace solidnoise
