#pragma once

#include <vector>

#include "solidnoise/core/points.h"
#include "solidnoise/field/pointwise_field.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid where it was put.
struct PlacedCloud {
  openvdb::FloatGrid::ConstPtr grid;  // around the origin of its own space; background 0
  openvdb::Mat4d to_world;            // from there, of rows: p' = p M
  Box<3> bounds;                      // in the world; outside of them the grid counts as 0
};

// The sum of grids where they were put, anywhere in the world: each interpolated trilinearly, in their order.
class PlacedClouds final : public PointwiseField {
 public:
  explicit PlacedClouds(const std::vector<PlacedCloud>& clouds);

  void evaluate(const Points<3>& points, const Samples<3>& samples) const override;
  bool empty(const Box<3>& box) const override;

 private:
  struct Cloud {
    openvdb::FloatGrid::ConstPtr grid;
    openvdb::Mat4d to_index;
    Box<3> bounds;
  };
  std::vector<Cloud> clouds_;
};

// Whether boxes have more than faces in common.
bool overlap(const Box<3>& a, const Box<3>& b);

}  // namespace solidnoise
