#include "solidnoise/noise/point/surface_points.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "solidnoise/noise/gabor/varying_parameters.h"

namespace solidnoise {

void SurfacePoints::validate() const {
  require_finite_positions(positions);
  for (const auto& component : normal) {
    if (component.size() != positions.count) {
      throw std::invalid_argument(
          fmt::format("there are {} normals for {} points", component.size(), positions.count));
    }
  }
  for (std::size_t i = 0; i < positions.count; ++i) {
    double square = 0.0;
    for (const auto& component : normal) square += static_cast<double>(component[i]) * component[i];
    if (!(square > 0.0 && std::isfinite(square))) {
      throw std::invalid_argument(fmt::format("normal of point {} is ({}, {}, {}); it must have a length", i,
                                              normal[0][i], normal[1][i], normal[2][i]));
    }
  }
}

}  // namespace solidnoise
