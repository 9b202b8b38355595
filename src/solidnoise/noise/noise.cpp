#include "solidnoise/noise/noise.h"

#include <vector>

#include "solidnoise/core/lattice_blocks.h"

namespace solidnoise {

void require_impulses(double impulses) {
  if (impulses != 0.0) require("impulses", impulses, kImpulses, "mean impulses per kernel; 0 chooses");
}

template <int Dim>
void Noise<Dim>::evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const {
  require_room(samples, lattice.size());
  const LatticeBlocks<Dim> blocks(lattice);
  std::vector<float> memory;
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    blocks.evaluate(*this, block, samples, memory);
  }
}

template <int Dim>
double Noise<Dim>::covariance(const Vec<Dim>& displacement) const {
  const auto parts = this->parts();
  if (parts.empty()) return waves().covariance(displacement);
  double sum = 0.0;
  for (const Part& part : parts) {
    sum += part.amplitude * part.amplitude * part.noise->covariance(displacement);
  }
  return sum;
}

template class Noise<1>;
template class Noise<2>;
template class Noise<3>;
template class Noise<4>;

}  // namespace solidnoise
