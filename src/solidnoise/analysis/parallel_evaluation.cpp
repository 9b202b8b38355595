#include "solidnoise/analysis/parallel_evaluation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "solidnoise/core/lattice_blocks.h"

namespace solidnoise {
namespace {

// Points that are evaluated together: enough to share impulses.
constexpr std::size_t kBatch = 1 << 14;
// Points that are put in order together, for which memory is taken.
constexpr std::size_t kSlab = 1 << 20;

// Within which noises of most frequencies can be evaluated, world units.
constexpr double kFarthest = 1e9;

void require_place(const char* what, std::size_t number, double x) {
  if (std::abs(x) <= kFarthest) return;  // what is not a number is not
  throw std::invalid_argument(fmt::format("{}[{}] is {}; it must be between {} and {} (world units)", what,
                                          number, x, -kFarthest, kFarthest));
}

template <int Dim>
std::vector<std::size_t> order_of(std::span<const Vec<Dim>> points) {
  if constexpr (Dim > 1) {
    if (points.size() > kBatch) return spatial_order(Points<Dim>{points});
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

// Copies samples of a batch, numbered by `places`, to where they belong among `size` samples of each channel.
void scatter(std::span<const float> from, std::span<const std::size_t> places, std::size_t first,
             std::size_t size, std::span<float> to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    to[i / places.size() * size + first + places[i % places.size()]] = from[i];
  }
}

}  // namespace

template <int Dim>
void evaluate_in_parallel(const Field<Dim>& field, const Lattice<Dim>& lattice, const Samples<Dim>& samples,
                          Progress* progress) {
  require_room(field, samples, lattice.size());
  const Box<Dim> bounds = lattice.bounds();
  for (int axis = 0; axis < Dim; ++axis) {
    for (const double end : {bounds.lower[axis], bounds.upper[axis]})
      require_place("lattice", static_cast<std::size_t>(axis), end);
  }
  const LatticeBlocks<Dim> blocks(lattice);
  tbb::enumerable_thread_specific<std::vector<float>> memory;
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
    throw_if_cancelled(progress);
    blocks.evaluate(field, block, samples, memory.local());
    if (progress != nullptr) progress->advance(++done, blocks.size());
  });
}

template <int Dim>
void evaluate_in_parallel(const Field<Dim>& field, const PointSource<Dim>& points,
                          const Samples<Dim>& samples, Progress* progress) {
  const std::size_t size = points.count;
  require_room(field, samples, size);
  const auto channels = static_cast<std::size_t>(field.channels());
  std::atomic<std::uint64_t> done{0};
  std::vector<Vec<Dim>> slab;
  for (std::size_t first = 0; first < size; first += slab.size()) {
    throw_if_cancelled(progress);
    slab.resize(std::min(kSlab, size - first));
    points.read(first, slab);
    for (std::size_t i = 0; i < slab.size(); ++i) {
      for (int axis = 0; axis < Dim; ++axis) require_place("points", first + i, slab[i][axis]);
    }
    const std::vector<std::size_t> order = order_of<Dim>(slab);
    const std::size_t batches = (slab.size() + kBatch - 1) / kBatch;
    tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t batch) {
      throw_if_cancelled(progress);
      const auto places =
          std::span(order).subspan(batch * kBatch, std::min(kBatch, slab.size() - batch * kBatch));
      std::vector<Vec<Dim>> positions;
      positions.reserve(places.size());
      for (const std::size_t place : places) positions.push_back(slab[place]);
      std::vector<float> memory(places.size() * channels * (samples.wants_gradient() ? 1 + Dim : 1));
      const auto part = [&](std::size_t k) {
        return std::span(memory).subspan(k * places.size() * channels, places.size() * channels);
      };
      Samples<Dim> of_batch{part(0), {}};
      for (std::size_t axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
        of_batch.gradient[axis] = part(1 + axis);
      }
      field.evaluate(Points<Dim>{positions}, of_batch);
      scatter(of_batch.values, places, first, size, samples.values);
      for (std::size_t axis = 0; samples.wants_gradient() && axis < Dim; ++axis) {
        scatter(of_batch.gradient[axis], places, first, size, samples.gradient[axis]);
      }
      if (progress != nullptr) progress->advance(done += places.size(), size);
    });
  }
}

template void evaluate_in_parallel(const Field<1>&, const Lattice<1>&, const Samples<1>&, Progress*);
template void evaluate_in_parallel(const Field<2>&, const Lattice<2>&, const Samples<2>&, Progress*);
template void evaluate_in_parallel(const Field<3>&, const Lattice<3>&, const Samples<3>&, Progress*);
template void evaluate_in_parallel(const Field<4>&, const Lattice<4>&, const Samples<4>&, Progress*);
template void evaluate_in_parallel(const Field<1>&, const PointSource<1>&, const Samples<1>&, Progress*);
template void evaluate_in_parallel(const Field<2>&, const PointSource<2>&, const Samples<2>&, Progress*);
template void evaluate_in_parallel(const Field<3>&, const PointSource<3>&, const Samples<3>&, Progress*);
template void evaluate_in_parallel(const Field<4>&, const PointSource<4>&, const Samples<4>&, Progress*);

}  // namespace solidnoise
