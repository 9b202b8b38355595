#pragma once

#include <cmath>
#include <cstdint>

namespace solidnoise {

// Where a coordinate lies in a one-dimensional grid of cells.
struct CellPosition {
  std::int64_t cell = 0;  // the cell's index
  float fraction = 0.0f;  // position in the cell, 0 to 1, a whole multiple of 2^-20
};

// One axis of a grid of cells. Positions are rounded to 2^-20 of a cell; every difference between two
// positions less than 16 cells (kExact) apart is then exact in single precision, so that whatever is computed
// from such differences does not depend on the block or batch it is computed in, and is as accurate a million
// units from the origin as at 0.
class CellAxis {
 public:
  static constexpr int kFractionBits = 20;
  static constexpr std::int64_t kQuantaPerCell = std::int64_t{1} << kFractionBits;
  static constexpr double kExact = 16.0;
  // Cells from 0 to the farthest coordinate: farther away, positions in the cells would have lost most of
  // their digits, and then overflow.
  static constexpr double kMostCells = 0x1p40;
  static constexpr double kMaxSpan = 12.0;  // cells a block may span, with a margin of 4 for its neighbours

  CellAxis() = default;
  // `size` in world units, > 0. The grid repeats after `period_cells` cells, or never if that is 0.
  explicit CellAxis(double size, std::int64_t period_cells = 0)
      : size_(size), cells_per_unit_(1.0 / size), period_cells_(period_cells) {}

  double size() const { return size_; }
  std::int64_t period_cells() const { return period_cells_; }

  // A coordinate in quanta of 2^-20 of a cell, rounded. Throws std::invalid_argument where it is not finite
  // or kMostCells or more from 0.
  std::int64_t quanta(double coordinate) const {
    const double scaled = coordinate * cells_per_unit_ * static_cast<double>(kQuantaPerCell) + 0.5;
    if (!(std::abs(scaled) < kMostCells * static_cast<double>(kQuantaPerCell))) refuse(coordinate);
    // The floor, by integers: std::floor is a slow call on processors without SSE 4.1.
    const std::int64_t truncated = static_cast<std::int64_t>(scaled);
    return truncated - (static_cast<double>(truncated) > scaled ? 1 : 0);
  }

  CellPosition locate(double coordinate) const {
    const std::int64_t position = quanta(coordinate);
    return {position >> kFractionBits,
            static_cast<float>(position & (kQuantaPerCell - 1)) / static_cast<float>(kQuantaPerCell)};
  }

  // The cell that holds the random content of `cell`: itself, or its representative in the first period.
  std::int64_t wrap(std::int64_t cell) const {
    if (period_cells_ == 0) return cell;
    const std::int64_t remainder = cell % period_cells_;
    return remainder < 0 ? remainder + period_cells_ : remainder;
  }

 private:
  [[noreturn]] void refuse(double coordinate) const;

  double size_ = 1.0;
  double cells_per_unit_ = 1.0;
  std::int64_t period_cells_ = 0;
};

}  // namespace solidnoise
