#include "solidnoise/noise/gabor/gabor_spectrum.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/core/check.h"
#include "solidnoise/core/named_error.h"
#include "solidnoise/core/special_functions.h"

namespace solidnoise {
namespace {

// Of a spectrum. Far within what doubles hold, for kernels' integrals go with a^-3 and noises choose another
// scale.
constexpr Interval kBandwidths = between(1e-16, 1e16);  // a, cycles per world unit
constexpr Interval kHighest = between(0.0, 1e16);       // of a component's frequency, the same
constexpr Interval kVariances = between(1e-60, 1e60);   // of all components together
constexpr Interval kOfPrincipal =
    between(1e-6, 1e6);  // of the principal frequency: a, and frequencies at most

[[noreturn]] void refuse(const std::string& path, double value, std::string_view allowed) {
  throw std::invalid_argument(fmt::format("{} is {}; it must be {}", path, value, allowed));
}

// The square root of the mean of |w|^2 + n a^2 / (4 pi) over the variance.
double principal_frequency_of(std::span<const GaborSpectrum> channels) {
  double variance = 0.0;
  double sum = 0.0;
  for (const GaborSpectrum& channel : channels) {
    for (const SpectrumBand& band : channel.bands) {
      const double width = channel.dimensions * band.a * band.a / (4.0 * std::numbers::pi);
      for (const SpectrumComponent& component : band.components) {
        variance += component.variance;
        sum += component.variance * (glm::dot(component.frequency, component.frequency) + width);
      }
    }
  }
  return std::sqrt(sum / variance);
}

void validate_component(const SpectrumComponent& component, const GaborSpectrum& spectrum,
                        const std::string& path) {
  const double variance = component.variance;
  if (!(variance >= 0.0) || !std::isfinite(variance)) {
    refuse(path + ".variance", variance, "0 or more, and finite");
  }
  require(path + ".frequency", glm::length(component.frequency), kHighest, "cycles per world unit");
  for (int axis = 0; axis < 3; ++axis) {
    const double frequency = component.frequency[axis];
    if (axis >= spectrum.dimensions && frequency != 0.0) {
      refuse(path + ".frequency", frequency, "0 on axes that the spectrum does not have");
    }
  }
  if (component.group < 0 || component.group >= static_cast<int>(spectrum.groups.size())) {
    refuse(path + ".group", component.group, "the number of a group, from 0");
  }
}

// The bands and frequencies against each other.
void validate_proportions(const GaborSpectrum& spectrum) {
  const double principal = principal_frequency_of({&spectrum, 1});
  const auto require_proportion = [&](const std::string& path, double value, double least) {
    const Interval allowed = between(least, kOfPrincipal.most);
    if (allowed.contains(value / principal)) return;
    refuse(path, value, fmt::format("{} times the principal frequency, {:.3g}", allowed.text(), principal));
  };
  for (std::size_t b = 0; b < spectrum.bands.size(); ++b) {
    const SpectrumBand& band = spectrum.bands[b];
    const std::string path = fmt::format("bands[{}]", b);
    require_proportion(path + ".a", band.a, kOfPrincipal.least);
    for (std::size_t i = 0; i < band.components.size(); ++i) {
      require_proportion(fmt::format("{}.components[{}].frequency", path, i),
                         glm::length(band.components[i].frequency), 0.0);
    }
  }
}

}  // namespace

double GaborSpectrum::variance() const {
  double sum = 0.0;
  for (const SpectrumBand& band : bands) {
    for (const SpectrumComponent& component : band.components) sum += component.variance;
  }
  return sum;
}

double GaborSpectrum::density(const Vec<3>& frequency) const {
  double sum = 0.0;
  for (const SpectrumBand& band : bands) {
    const double sharpness = 2.0 * std::numbers::pi / (band.a * band.a);
    double total = 0.0;
    for (const SpectrumComponent& component : band.components) {
      const Vec<3>& w = component.frequency;
      if (isotropic) {
        // The mean of the Gaussian over all directions of w.
        const double f = glm::length(frequency);
        const double centre = glm::length(w);
        total += component.variance * std::exp(-sharpness * (f - centre) * (f - centre)) *
                 mean_exponential_scaled(dimensions, 2.0 * sharpness * f * centre);
      } else {
        const double there = glm::dot(frequency - w, frequency - w);
        const double back = glm::dot(frequency + w, frequency + w);
        total += 0.5 * component.variance * (std::exp(-sharpness * there) + std::exp(-sharpness * back));
      }
    }
    sum += total * std::pow(std::numbers::sqrt2 / band.a, dimensions);
  }
  return sum;
}

double GaborSpectrum::covariance(const Vec<3>& offset) const {
  const double distance = glm::length(offset);
  double sum = 0.0;
  for (const SpectrumBand& band : bands) {
    double waves = 0.0;
    for (const SpectrumComponent& component : band.components) {
      const Vec<3>& w = component.frequency;
      waves += component.variance *
               (isotropic ? mean_cosine(dimensions, 2.0 * std::numbers::pi * glm::length(w) * distance)
                          : std::cos(2.0 * std::numbers::pi * glm::dot(w, offset)));
    }
    sum += waves * std::exp(-0.5 * std::numbers::pi * band.a * band.a * distance * distance);
  }
  return sum;
}

GaborSpectrum GaborSpectrum::scaled(double factor) const {
  GaborSpectrum result = *this;
  for (SpectrumBand& band : result.bands) {
    band.a *= factor;
    for (SpectrumComponent& component : band.components) component.frequency *= factor;
  }
  return result;
}

GaborSpectrum GaborSpectrum::filtered(double b) const {
  GaborSpectrum result = *this;
  for (SpectrumBand& band : result.bands) {
    const double sum = band.a * band.a + b * b;
    const double narrower = b * b / sum;  // squared
    for (SpectrumComponent& component : band.components) {
      const double square = glm::dot(component.frequency, component.frequency);
      component.variance *=
          std::pow(narrower, 0.5 * dimensions) * std::exp(-2.0 * std::numbers::pi * square / sum);
      component.frequency *= narrower;
    }
    band.a *= std::sqrt(narrower);
  }
  return result;
}

void GaborSpectrum::validate() const {
  if (dimensions != 2 && dimensions != 3) refuse("dimensions", dimensions, "2 or 3");
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const std::string path = fmt::format("bands[{}]", b);
    require(path + ".a", bands[b].a, kBandwidths, "cycles per world unit");
    for (std::size_t i = 0; i < bands[b].components.size(); ++i) {
      validate_component(bands[b].components[i], *this, fmt::format("{}.components[{}]", path, i));
    }
  }
  const double total = variance();
  if (!kVariances.contains(total)) {
    throw std::invalid_argument(fmt::format(
        "the variances of all components add up to {}; the sum must be {}", total, kVariances.text()));
  }
  validate_proportions(*this);
}

double ExemplarModel::principal_frequency() const {
  return principal_frequency_of(channels);
}

Vec<3> ExemplarModel::variances() const {
  Vec<3> sum(0.0);
  for (std::size_t k = 0; k < channels.size(); ++k) sum += channels[k].variance() * axes[k] * axes[k];
  return sum;
}

Vec<3> ExemplarModel::mean_color() const {
  return squares ? mean * mean + variances() : mean;
}

ChannelColors::ChannelColors(const ExemplarModel& model, std::span<const double> variances)
    : mean_(model.mean), squares_(model.squares) {
  for (std::size_t k = 0; k < model.channels.size(); ++k) {
    const double variance = model.channels[k].variance();
    channels_.push_back({std::sqrt(variance), model.axes[k]});
    if (!variances.empty()) taken_ += (1.0 - variances[k]) * variance * model.axes[k] * model.axes[k];
  }
}

Vec<3> ChannelColors::operator()(std::span<const double> values) const {
  Vec<3> sum = mean_;
  for (std::size_t k = 0; k < channels_.size(); ++k)
    sum += channels_[k].deviation * values[k] * channels_[k].axis;
  return squares_ ? sum * sum + taken_ : sum;
}

void ExemplarModel::validate() const {
  if (channels.size() != 1 && channels.size() != 3) {
    refuse("number of channels", static_cast<double>(channels.size()), "1 or 3");
  }
  if (axes.size() != channels.size()) {
    throw std::invalid_argument(
        fmt::format("there are {} axes for {} channels; each needs one", axes.size(), channels.size()));
  }
  for (std::size_t k = 0; k < channels.size(); ++k) {
    in_field(fmt::format("channels[{}]: ", k), [&] { channels[k].validate(); });
    const GaborSpectrum& first = channels.front();
    if (channels[k].dimensions != first.dimensions || channels[k].isotropic != first.isotropic) {
      throw std::invalid_argument(fmt::format("channels[{}] is of another kind than channels[0]", k));
    }
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(axes[k][i])) refuse(fmt::format("axes[{}]", k), axes[k][i], "finite");
      if (!std::isfinite(mean[i])) refuse("mean", mean[i], "finite");
    }
  }
}

}  // namespace solidnoise
