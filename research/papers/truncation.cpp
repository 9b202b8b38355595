#include "papers/truncation.h"

#include <cmath>
#include <vector>

#include "papers/paper_kernel.h"
#include "reference/gabor_reference.h"
#include "solidnoise/core/random.h"
#include "solidnoise/noise/kernel/isotropic_gabor_kernel.h"

namespace solidnoise::papers {
namespace {

// As many impulses as the volume holds on average, a number that does not scatter, uniform in a box from
// -margin to side + margin.
template <int Dim>
std::vector<reference::Impulse<Dim>> scatter_impulses(const TruncationOptions& options, double margin) {
  const double length = options.side + 2.0 * margin;
  const auto count = static_cast<int>(std::lround(options.density * std::pow(length, Dim)));
  RandomStream stream(options.seed);
  std::vector<reference::Impulse<Dim>> impulses(static_cast<std::size_t>(count));
  for (reference::Impulse<Dim>& impulse : impulses) {
    for (int axis = 0; axis < Dim; ++axis) {
      const double place = stream.next_unit();
      impulse.position[static_cast<std::size_t>(axis)] = place * length - margin;
    }
    impulse.weight = 2.0 * stream.next_unit() - 1.0;
  }
  return impulses;
}

// The kernel's values, for radii up to a reach; between entries it is linear, within 1e-5 of the maximum.
template <int Dim>
class KernelTable {
 public:
  KernelTable(const IsotropicGaborKernel<Dim>& kernel, double reach) {
    for (double r = 0.0; r <= reach + 2.0 * kStep; r += kStep) values_.push_back(kernel.value(r));
  }
  double operator()(double r) const {
    const double place = r / kStep;
    const auto below = static_cast<std::size_t>(place);
    if (below + 1 >= values_.size()) return 0.0;
    const double t = place - static_cast<double>(below);
    return (1.0 - t) * values_[below] + t * values_[below + 1];
  }

 private:
  static constexpr double kStep = 0.02;
  std::vector<double> values_;
};

// Sums of the noise at a point: within the radius, and beyond.
template <int Dim>
struct SplitSum {
  double inner = 0.0;
  double outer = 0.0;
};

template <int Dim>
SplitSum<Dim> sum_at(const reference::Position<Dim>& point, double radius, double reach,
                     const std::vector<reference::Impulse<Dim>>& impulses, const KernelTable<Dim>& kernel) {
  SplitSum<Dim> sum;
  for (const reference::Impulse<Dim>& impulse : impulses) {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const double offset = point[axis] - impulse.position[axis];
      squared += offset * offset;
    }
    if (squared >= reach * reach) continue;
    const double distance = std::sqrt(squared);
    (distance < radius ? sum.inner : sum.outer) += impulse.weight * kernel(distance);
  }
  return sum;
}

// The root mean square, and its standard error from that of parts of the field.
void measure_error(TruncatedNoise& noise) {
  constexpr std::size_t kParts = 16;
  const std::vector<float>& values = noise.difference.values;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t first = part * values.size() / kParts;
    const std::size_t last = (part + 1) * values.size() / kParts;
    double power = 0.0;
    for (std::size_t i = first; i < last; ++i) power += static_cast<double>(values[i]) * values[i];
    power /= static_cast<double>(last - first);
    sum += power;
    sum_of_squares += power * power;
  }
  const double mean = sum / kParts;
  noise.error_rms = std::sqrt(mean);
  const double scatter = std::sqrt((sum_of_squares / kParts - mean * mean) / (kParts - 1));
  noise.standard_error = 0.5 * scatter / noise.error_rms;
}

}  // namespace

template <int Dim>
TruncatedNoise truncate_noise(const TruncationOptions& options) {
  const IsotropicGaborKernel<Dim> kernel(kAmplitude, kFrequency, kGaussian);
  const double reach = kernel.gaussian_radius(1e-6);
  const KernelTable<Dim> table(kernel, reach);
  const std::vector<reference::Impulse<Dim>> impulses = scatter_impulses<Dim>(options, reach);

  TruncatedNoise noise;
  noise.radius = kernel.radius_for_error(options.error);
  noise.noise_rms = 1.0;
  noise.expected_rms = options.error;
  constexpr double kMeanSquaredWeight = 1.0 / 3.0;
  const double scale = 1.0 / std::sqrt(options.density * kMeanSquaredWeight * kernel.energy());
  noise.whole = DenseField<2>({options.side, Dim == 1 ? 1 : options.side}, Vec<2>(1.0));
  noise.truncated = noise.whole;
  noise.difference = noise.whole;
  for (std::size_t i = 0; i < noise.whole.values.size(); ++i) {
    const glm::ivec2 at = ArrayShape<2>{noise.whole.count}.position(i);
    reference::Position<Dim> point;
    for (int axis = 0; axis < Dim; ++axis) point[static_cast<std::size_t>(axis)] = at[axis];
    const SplitSum<Dim> sum = sum_at<Dim>(point, noise.radius, reach, impulses, table);
    noise.whole.values[i] = static_cast<float>(scale * (sum.inner + sum.outer));
    noise.truncated.values[i] = static_cast<float>(scale * sum.inner);
    noise.difference.values[i] = static_cast<float>(scale * sum.outer);
  }
  measure_error(noise);
  return noise;
}

template TruncatedNoise truncate_noise<1>(const TruncationOptions&);
template TruncatedNoise truncate_noise<2>(const TruncationOptions&);

}  // namespace solidnoise::papers
