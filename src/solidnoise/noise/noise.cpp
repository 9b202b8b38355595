#include "solidnoise/noise/noise.h"

#include <algorithm>
#include <vector>

namespace solidnoise {
namespace {

// Samples along each axis of one block: enough to share impulses, few enough to keep them in the cache. Time
// is not shared.
template <int Dim>
constexpr std::array<int, Dim> block_size() {
  if constexpr (Dim == 1) return {4096};
  if constexpr (Dim == 2) return {64, 64};
  if constexpr (Dim == 3) return {32, 32, 32};
  if constexpr (Dim == 4) return {32, 32, 32, 1};
}

// A box of a lattice's samples.
template <int Dim>
struct Chunk {
  glm::vec<Dim, int> start{0};
  glm::vec<Dim, int> count{1};
};

// Copies a chunk's dense samples to where the lattice has them.
template <int Dim>
void scatter(const Chunk<Dim>& chunk, const glm::vec<Dim, int>& lattice_count, std::span<const float> from,
             std::span<float> to) {
  const int row = chunk.count[Dim - 1];
  glm::vec<Dim, int> index(0);
  for (std::size_t done = 0; done < from.size(); done += static_cast<std::size_t>(row)) {
    std::size_t offset = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      offset = offset * static_cast<std::size_t>(lattice_count[axis]) +
               static_cast<std::size_t>(chunk.start[axis] + index[axis]);
    }
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(done), row,
                to.begin() + static_cast<std::ptrdiff_t>(offset));
    for (int axis = Dim - 2; axis >= 0 && ++index[axis] == chunk.count[axis]; --axis) index[axis] = 0;
  }
}

}  // namespace

void require_impulses(double impulses) {
  if (impulses != 0.0) require("impulses", impulses, kImpulses, "mean impulses per kernel; 0 chooses");
}

template <int Dim>
void Noise<Dim>::evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const {
  require_room(samples, lattice.size());
  constexpr auto kBlock = block_size<Dim>();
  std::array<std::vector<float>, 1 + Dim> buffers;
  Chunk<Dim> chunk;
  while (true) {
    Lattice<Dim> inside = lattice;
    for (int axis = 0; axis < Dim; ++axis) {
      chunk.count[axis] = std::min(kBlock[axis], lattice.count[axis] - chunk.start[axis]);
      inside.first[axis] += chunk.start[axis];
    }
    inside.count = chunk.count;
    for (auto& buffer : buffers) buffer.resize(inside.size());

    Samples<Dim> dense{buffers[0], {}};
    for (int axis = 0; samples.wants_gradient() && axis < Dim; ++axis)
      dense.gradient[axis] = buffers[1 + axis];
    this->block(inside.bounds())->evaluate(inside, dense);
    scatter<Dim>(chunk, lattice.count, buffers[0], samples.values);
    for (int axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
      scatter<Dim>(chunk, lattice.count, buffers[1 + axis], samples.gradient[axis]);
    }

    int axis = Dim - 1;
    while (axis >= 0 && (chunk.start[axis] += kBlock[axis]) >= lattice.count[axis]) chunk.start[axis--] = 0;
    if (axis < 0) return;
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
