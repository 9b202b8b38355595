#include "solidnoise/noise/gabor/gabor_options.h"

#include <stdexcept>

#include <glm/geometric.hpp>

#include "solidnoise/noise/gabor/gabor_fields.h"

namespace solidnoise {

void GaborNoiseOptions::validate() const {
  require_fields(*this);
  evolution.validate();
}

void OrientedGaborNoiseOptions::validate() const {
  require_fields(*this);
  evolution.validate();
  if (glm::dot(direction, direction) == 0.0)
    throw std::invalid_argument("direction is 0; it must have a length");
}

}  // namespace solidnoise
