#include "solidnoise/analysis/exemplar/channel_spectra.h"

#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace solidnoise {

std::vector<std::vector<double>> channel_weights(const ExemplarChannels& channels) {
  if (channels.axes.size() == 1) {
    const double direction = channels.directions[0][0];
    return {{direction * direction}};
  }
  glm::dmat3 products;
  Vec<3> powers;  // of the colours, per channel
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      const double product =
          glm::dot(channels.axes[static_cast<std::size_t>(k)], channels.axes[static_cast<std::size_t>(l)]);
      products[k][l] = product * product;
    }
    powers[k] = std::sqrt(products[k][k]);
  }
  const glm::dmat3 inverse = glm::inverse(products);
  const Vec<3> shares = inverse * powers / glm::dot(powers, inverse * powers);
  std::vector<std::vector<double>> result(3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Vec<3> along;  // of a cross-spectrum of 1 between colours i and j
      for (int k = 0; k < 3; ++k) {
        const Vec<3>& axis = channels.axes[static_cast<std::size_t>(k)];
        along[k] = axis[i] * axis[j];
      }
      const Vec<3> nearest = inverse * along;
      const double power = i == j ? 1.0 : 0.0;
      const Vec<3> weights = nearest + (power - glm::dot(powers, nearest)) * shares;
      for (int k = 0; k < 3; ++k) result[static_cast<std::size_t>(k)].push_back(weights[k]);
    }
  }
  return result;
}

template <int Dim>
std::vector<PowerSpectrum<Dim>> channel_spectra(const CrossSpectra<Dim>& spectra,
                                                const ExemplarChannels& channels) {
  std::vector<PowerSpectrum<Dim>> result;
  for (const std::vector<double>& weights : channel_weights(channels))
    result.push_back(spectra.weighted(weights));
  return result;
}

template std::vector<PowerSpectrum<2>> channel_spectra<2>(const CrossSpectra<2>&, const ExemplarChannels&);
template std::vector<PowerSpectrum<3>> channel_spectra<3>(const CrossSpectra<3>&, const ExemplarChannels&);

}  // namespace solidnoise
