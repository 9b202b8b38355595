#include "solidnoise/mesh/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

namespace solidnoise {

void set_vertex_colors(PolygonMesh& mesh, std::span<const Color> colors) {
  constexpr double kWhole = 255.0;
  for (std::size_t channel = 0; channel < kColorNames.size(); ++channel) {
    VertexProperty property{std::string(kColorNames[channel]), ScalarType::uint8,
                            std::vector<double>(colors.size(), kWhole)};
    if (channel < 3) {
      tbb::parallel_for(std::size_t{0}, colors.size(), [&](std::size_t i) {
        const double encoded = srgb_from_linear(colors[i][static_cast<int>(channel)]);
        property.values[i] = std::round(kWhole * std::clamp(encoded, 0.0, 1.0));
      });
    }
    mesh.set_property(std::move(property));
  }
}

}  // namespace solidnoise
