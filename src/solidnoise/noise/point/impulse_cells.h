#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>

#include "solidnoise/core/cell_grid.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/noise/convolution/impulse_process.h"

namespace solidnoise {

// The impulses of a process cell by cell; a cell is a cube of `parts` strata along each axis, and has their
// impulses.
template <int Dim>
class ImpulseCells {
 public:
  struct Item {
    std::array<float, Dim> position;  // in cells, from the cell's corner, 0 to span()
    float weight;                     // 1 or -1, times the factor of its mark
    float share;                      // uniform on [0, 1)
  };

  using Factor = std::function<double(std::uint64_t mark)>;  // empty: 1

  ImpulseCells(ImpulseProcess<Dim> process, int parts, Factor factor)
      : process_(std::move(process)),
        parts_(parts),
        axis_(parts * process_.axes()[0].size()),
        factor_(std::move(factor)) {}

  const CellAxis& axis() const { return axis_; }
  // Cells along an axis that the impulses of a cell may lie in.
  static float span(const ImpulseProcess<Dim>& process, int parts) {
    return 1.0f + static_cast<float>(process.span() - 1) / static_cast<float>(parts);
  }

  // Calls sink(item) for the impulses of a cell that are in reach, which is in strata, in a fixed order.
  template <typename Sink>
  void generate(const Index<Dim>& cell, const ImpulseReach<Dim>& reach, const Sink& sink) const {
    const Index<Dim> first = cell * std::int64_t{parts_};
    process_.generate(first, first + std::int64_t{parts_ - 1}, reach,
                      [&](const Index<Dim>& stratum, const Impulse<Dim>& impulse) {
                        sink(item_of(impulse, stratum - first));
                      });
  }

 private:
  // `part`: the stratum of the cell that it belongs to.
  Item item_of(const Impulse<Dim>& impulse, const Index<Dim>& part) const {
    Item item;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const auto place =
          static_cast<std::int32_t>(part[axis] * CellAxis::kQuantaPerCell + impulse.position[a]);
      item.position[a] = static_cast<float>(place) / static_cast<float>(parts_ * CellAxis::kQuantaPerCell);
    }
    item.weight = impulse.mark >> 63 ? 1.0f : -1.0f;
    if (factor_) item.weight *= static_cast<float>(factor_(impulse.mark));
    item.share = static_cast<float>(share_of(impulse.mark));
    return item;
  }

  ImpulseProcess<Dim> process_;
  int parts_;
  CellAxis axis_;
  Factor factor_;
};

}  // namespace solidnoise
