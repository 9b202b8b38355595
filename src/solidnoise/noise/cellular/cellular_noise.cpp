#include "solidnoise/noise/cellular/cellular_noise.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/cellular/cellular_entry.h"
#include "solidnoise/noise/cellular/nearest.h"
#include "solidnoise/noise/convolution/kernel_cells.h"

namespace solidnoise {

void CellularNoiseOptions::validate() const {
  require_fields(*this);
}

namespace {

CellularNoiseOptions validated(const CellularNoiseOptions& options) {
  options.validate();
  return options;
}

// The ball where distances end holds this many points on average: fewer than two with a probability of 3e-12.
constexpr double kPointsInReach = 30.0;
constexpr double kReach = 2.0;  // its radius, in cells

// What a convolution leaves to its kernel, which here is no sum.
class NearestKernel final : public ImpulseKernel {
 public:
  explicit NearestKernel(const NearestDistance& nearest) : nearest_(nearest) {}

  CullBox::Support support() const override { return CullBox::Support::ball; }
  int attribute_count() const override { return 0; }
  void draw(std::span<const std::uint64_t>, ImpulseAttributes&) const override {}

  void sum(const ImpulseList& list, const SampleBrick& brick, Derivatives derivatives,
           BrickSums& sums) const override {
    find_nearest(nearest_, list, brick, derivatives, sums);
  }
  void sum(const ImpulseList& list, const SampleCluster& cluster, Derivatives derivatives,
           ClusterSums& sums) const override {
    find_nearest(nearest_, list, cluster, derivatives, sums);
  }

 private:
  NearestDistance nearest_;
};

}  // namespace

template <int Dim>
CellularNoise<Dim>::CellularNoise(const CellularNoiseOptions& options)
    : options_(validated(options)), statistics_(options.feature) {
  const double radius_in_spacings = std::pow(kPointsInReach / unit_ball_volume(Dim), 1.0 / Dim);
  radius_ = radius_in_spacings / options.frequency;
  const StrataChoice cells{
      .dimensions = Dim, .moments = {}, .weights = {}, .averages = {}, .radius = radius_ / kReach};
  const ImpulseLayout<Dim> layout = make_layout<Dim>(cells, std::pow(options.frequency, Dim),
                                                     ImpulseSpread::poisson, radius_, options.period);
  const std::array<double, Dim> radius_in_cells = layout.in_cells(radius_);
  const double deviation = std::sqrt(statistics_.variance());
  nearest_ = std::make_shared<const SparseConvolution<Dim>>(
      ImpulseProcess<Dim>(layout.axes, layout.count, derive_seed(options.seed, kImpulseStream)),
      std::make_shared<const NearestKernel>(
          NearestDistance{.dimensions = Dim,
                          .scale = support_scale<Dim>(radius_in_cells),
                          .border = options.feature == CellularNoiseOptions::Feature::border,
                          .lift = static_cast<float>(-statistics_.mean() / radius_in_spacings)}),
      radius_in_cells, radius_in_spacings / deviation);
}

template <int Dim>
Vec<Dim> CellularNoise<Dim>::gradient_variance() const {
  return Vec<Dim>(statistics_.gradient_variance() / statistics_.variance() * std::pow(options_.frequency, 2));
}

template <int Dim>
double CellularNoise<Dim>::power_spectrum(const Vec<Dim>& frequency) const {
  return statistics_.power_spectrum(glm::length(frequency) / options_.frequency) /
         (statistics_.variance() * std::pow(options_.frequency, Dim));
}

template <int Dim>
double CellularNoise<Dim>::covariance(const Vec<Dim>& displacement) const {
  return statistics_.covariance(glm::length(displacement) * options_.frequency) / statistics_.variance();
}

template <int Dim>
Band CellularNoise<Dim>::band() const {
  const Band cells = statistics_.band();
  return {cells.lower * options_.frequency, cells.upper * options_.frequency};
}

template class CellularNoise<1>;
template class CellularNoise<2>;
template class CellularNoise<3>;
template class CellularNoise<4>;

}  // namespace solidnoise
