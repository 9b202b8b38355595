#include "solidnoise/analysis/exemplar/prepare_exemplars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "solidnoise/analysis/exemplar/square_colors.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/image/color.h"

namespace solidnoise {

void make_grey(Exemplar<2>& exemplar) {
  if (exemplar.channels.size() == 1) return;
  constexpr std::array kWeights{0.2126f, 0.7152f, 0.0722f};
  DenseField<2> grey(exemplar.shape().count, exemplar.shape().step);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
      grey.values[i] += kWeights[c] * exemplar.channels[c].values[i];
    }
  }
  exemplar.channels = {grey};
}

void agree_on_channels(std::vector<Exemplar<2>>& exemplars) {
  bool color = false;
  for (const Exemplar<2>& exemplar : exemplars) color = color || exemplar.channels.size() == 3;
  if (!color) return;
  for (Exemplar<2>& exemplar : exemplars) exemplar.channels.resize(3, exemplar.channels.front());
}

namespace {

// The share of a normal distribution below 0, and above 1; of squares beyond 1 on either side.
double clipped_share(const Moments& moments, bool squares) {
  if (!(moments.sigma() > 0.0)) return 0.0;
  const auto beyond = [&](double distance) {
    return 0.5 * std::erfc(distance / (std::sqrt(2.0) * moments.sigma()));
  };
  return beyond(1.0 - moments.mean()) + beyond(moments.mean() + (squares ? 1.0 : 0.0));
}

ValueFit fit_of(std::span<const Exemplar<2>> exemplars, bool squares) {
  ValueFit mean;
  for (const Exemplar<2>& exemplar : exemplars) {
    double clipped = 0.0;
    double skewness = 0.0;
    for (const DenseField<2>& channel : exemplar.channels) {
      const Moments moments = Moments::of(channel.values);
      clipped += clipped_share(moments, squares);
      if (std::abs(moments.skewness()) > std::abs(skewness)) skewness = moments.skewness();
    }
    const auto count = static_cast<double>(exemplars.size());
    mean.clipped += clipped / (count * static_cast<double>(exemplar.channels.size()));
    mean.skewness += skewness / count;
  }
  return mean;
}

}  // namespace

ValueFit fit_of_values(std::span<const Exemplar<2>> exemplars) {
  return fit_of(exemplars, false);
}

bool are_squares(std::span<const Exemplar<2>> exemplars) {
  std::array<Moments, 3> colors;
  for (const Exemplar<2>& exemplar : exemplars) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t channel = exemplar.channels.size() == 1 ? 0 : c;
      colors[c].merge(Moments::of(exemplar.channels[channel].values));
    }
  }
  return std::ranges::all_of(colors, [](const Moments& moments) {
    return moments.min() >= 0.0 && reached_share(moments.mean(), std::pow(moments.sigma(), 2)) == 1.0;
  });
}

ValueChoice choose_values(std::vector<Exemplar<2>>& exemplars, const std::vector<bool>& hold_linear_light,
                          bool may_square) {
  constexpr double kClipped = 0.005;  // as bad as a skewness of 1
  const auto cost = [](const ValueFit& fit) { return fit.clipped / kClipped + std::abs(fit.skewness); };
  std::vector<Exemplar<2>> linear = exemplars;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    if (hold_linear_light[i]) continue;
    for (DenseField<2>& channel : linear[i].channels) {
      for (float& value : channel.values) value = linear_from_srgb(value);
    }
  }
  const ValueFit of_stored = fit_of_values(exemplars);
  const ValueFit of_linear = fit_of_values(linear);
  const bool any_linear =
      std::find(hold_linear_light.begin(), hold_linear_light.end(), true) != hold_linear_light.end();
  if (!any_linear) {
    const double otherwise = std::min(of_stored.clipped, of_linear.clipped);
    if (may_square && otherwise > kClipped && are_squares(exemplars)) {
      const ValueFit of_squares = fit_of(square_roots(std::span<const Exemplar<2>>(exemplars)), true);
      if (of_squares.clipped < 0.5 * otherwise &&
          cost(of_squares) < std::min(cost(of_stored), cost(of_linear)))
        return {.raw_values = true, .squares = true, .fit = of_squares};
    }
    if (cost(of_stored) <= cost(of_linear)) return {.raw_values = true, .fit = of_stored};
  }
  exemplars = std::move(linear);
  return {.fit = of_linear};
}

}  // namespace solidnoise
