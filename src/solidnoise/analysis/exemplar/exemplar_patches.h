#pragma once

#include <span>
#include <vector>

#include "solidnoise/analysis/dense_field.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/core/progress.h"

namespace solidnoise {

inline constexpr int kSmallestPatch = 16;  // samples along an axis

// The largest count of at most `count` whose transforms are fast and that the bands' coarser grids divide
// well: an even number without prime factors above 7. At most 14 % of an axis' samples are left out, 8 % if
// it has 100 or more.
int fast_count(int count);

// Where patches of `count` samples begin in an exemplar, which has at least as many along each axis: spread
// evenly, overlapping by half at most.
template <int Dim>
std::vector<glm::vec<Dim, int>> patch_origins(const Exemplar<Dim>& exemplar, const glm::vec<Dim, int>& count);

// The samples of a field in such a patch.
template <int Dim>
DenseField<Dim> cut_patch(const DenseField<Dim>& field, const glm::vec<Dim, int>& origin,
                          const glm::vec<Dim, int>& count);

// Calls visit(patch of each channel) for all patches of all exemplars. Throws Cancelled where `progress`,
// which may be null, asks to stop.
template <int Dim, typename Visit>
void for_each_patch(std::span<const Exemplar<Dim>> exemplars, const glm::vec<Dim, int>& count,
                    Progress* progress, const Visit& visit) {
  for (const Exemplar<Dim>& exemplar : exemplars) {
    for (const glm::vec<Dim, int>& origin : patch_origins(exemplar, count)) {
      throw_if_cancelled(progress);
      std::vector<DenseField<Dim>> patch;
      for (const DenseField<Dim>& channel : exemplar.channels)
        patch.push_back(cut_patch(channel, origin, count));
      visit(patch);
    }
  }
}

}  // namespace solidnoise
