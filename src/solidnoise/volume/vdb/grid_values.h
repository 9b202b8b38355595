#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "solidnoise/core/moments.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Moments of a leaf's active voxels, of each component.
Moments measure(const openvdb::FloatTree::LeafNodeType& leaf);
std::array<Moments, 3> measure(const openvdb::Vec3STree::LeafNodeType& leaf);

// Moments of a grid's active voxels, leaf by leaf in tree order, in parallel: the same to the last bit for
// any number of threads. Active tiles count with all their voxels.
Moments measure(const openvdb::FloatGrid& grid);
std::array<Moments, 3> measure(const openvdb::Vec3SGrid& grid);

// Merges those of a grid's leaves into what came before: grids that hold the parts of one in tree order give
// what measure() does of it. One for each component of a grid of floats or of vectors; without tiles.
void merge_moments(const openvdb::GridBase& grid, std::vector<Moments>& total);

// Counts in bins of equal width; bin k holds lower + k w <= v < lower + (k + 1) w, the last one `upper` too.
struct Histogram {
  double lower = 0.0;
  double upper = 1.0;
  std::vector<std::uint64_t> counts;
  std::uint64_t below = 0;  // values under `lower`
  std::uint64_t above = 0;  // values over `upper`, and those that are not a number
};

// Histogram of a grid's active voxels. Throws std::invalid_argument unless lower < upper and bins >= 1.
Histogram histogram(const openvdb::FloatGrid& grid, double lower, double upper, int bins);

// Sums of the active values in each line of voxels along an axis (0, 1 or 2), of grids within a box. Grids
// that are added in the order in which they lie along the axis give the same sums, to the last bit, as one
// grid that has all of their voxels. Throws std::invalid_argument for another axis.
class ColumnSums {
 public:
  ColumnSums(const openvdb::CoordBBox& voxels, int axis);

  void add(const openvdb::FloatGrid& grid);
  double largest() const;  // 0 where the box is empty

 private:
  double& column(const openvdb::Coord& voxel);

  openvdb::CoordBBox voxels_;
  int axis_;
  int across_;  // the two other axes
  int along_;
  std::vector<double> sums_;
};

// The optical depth of the thickest column along an axis (0, 1 or 2): the largest integral of the grid's
// values, taken as extinction per world unit, over all lines of voxels parallel to the axis.
double thickest_column(const openvdb::FloatGrid& grid, int axis);

// The largest number that a grid may hold which is stored as 16-bit floats (IEEE 754 binary16).
inline constexpr double kLargestHalf = 65504.0;

// Throws std::invalid_argument if values of a grid of floats or of vectors of them are not finite, whether
// their voxels are active or not, or are beyond what it is stored as: how many, and where the first one is.
// `name` says in the message which grid it is. Grids of other types pass.
void require_finite_values(const openvdb::GridBase& grid, const std::string& name);

// A grid of vec3s or vec3d as one of vec3s, which shares the tree if it is one already. Null for a grid of
// another type.
openvdb::Vec3SGrid::ConstPtr in_single_precision(const openvdb::GridBase& grid);

// 64 bits that tell grids apart which differ by accident: a hash of transform, tree, and all values of a grid
// of floats or of vec3s; of another type the tree's shape counts alone. In parallel; the same for any number
// of threads.
std::uint64_t checksum(const openvdb::GridBase& grid);

}  // namespace solidnoise
