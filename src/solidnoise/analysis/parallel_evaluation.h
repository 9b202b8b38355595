#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "solidnoise/core/field.h"
#include "solidnoise/core/points.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {

// Evaluates a field in parallel, of 1 to 4 dimensions: on a lattice of any size, or at points in any order,
// which are taken together with their neighbours. Values are those of the field itself, to the last bit, for
// any number of threads. Progress counts samples. Throws std::invalid_argument for samples without room, and
// a position that is not finite or farther than 1e9 world units; Cancelled; what the field throws.
template <int Dim>
void evaluate_in_parallel(const Field<Dim>& field, const Lattice<Dim>& lattice, const Samples<Dim>& samples,
                          Progress* progress = nullptr);

// Overwrites `positions` by those of the points from `first` on; may be called by any thread.
template <int Dim>
using ReadPositions = std::function<void(std::size_t first, std::span<Vec<Dim>> positions)>;

// For points that are elsewhere, and may be many: a million is read at a time.
template <int Dim>
struct PointSource {
  std::size_t count = 0;
  ReadPositions<Dim> read;
};
template <int Dim>
void evaluate_in_parallel(const Field<Dim>& field, const PointSource<Dim>& points,
                          const Samples<Dim>& samples, Progress* progress = nullptr);

}  // namespace solidnoise
