#include "solidnoise/noise/gabor/gabor_options.h"

#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "solidnoise/noise/gabor/gabor_entries.h"
#include "solidnoise/noise/kernel/gabor_parameters.h"

namespace solidnoise {

namespace {

template <typename Options>
void validate_common(const Options& options) {
  require_fields(options);
  require_impulses(options.impulses);
  require_filter(options.filter);
  options.evolution.validate();
}

}  // namespace

void GaborNoiseOptions::validate() const {
  validate_common(*this);
}

void OrientedGaborNoiseOptions::validate() const {
  validate_common(*this);
  if (glm::dot(direction, direction) == 0.0)
    throw std::invalid_argument("direction is 0; it must have a length");
}

std::string NoiseEntry<GaborNoiseOptions>::why_fixed(const GaborNoiseOptions& options) {
  return options.weights == ImpulseWeights::uniform ? "uniform weights" : "";
}

std::string NoiseEntry<OrientedGaborNoiseOptions>::why_fixed(const OrientedGaborNoiseOptions& options) {
  if (options.anisotropy == 0.0 || options.anisotropy == 1.0) return "";
  return fmt::format("an anisotropy of {}; it must be 0, all directions alike, or 1, one direction",
                     options.anisotropy);
}

}  // namespace solidnoise
