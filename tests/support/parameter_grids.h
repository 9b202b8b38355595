#pragma once

#include <cmath>
#include <string>

#include "solidnoise/volume/vdb/openvdb.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "support/temporary_folder.h"

namespace solidnoise {

// A grid whose active voxels, those of `box`, have the value that `at(x, y, z)` gives at their centres in the
// world.
template <typename Grid, typename At>
typename Grid::Ptr grid_of(const std::string& name, double voxel, const openvdb::CoordBBox& box,
                           const At& at) {
  const auto grid = Grid::create();
  grid->setName(name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  auto accessor = grid->getAccessor();
  for (auto voxel_at = box.begin(); voxel_at; ++voxel_at) {
    const openvdb::Vec3d p = grid->indexToWorld(*voxel_at);
    accessor.setValue(*voxel_at, at(p.x(), p.y(), p.z()));
  }
  return grid;
}

inline openvdb::CoordBBox cube_of(int lower, int upper) {
  return {openvdb::Coord(lower), openvdb::Coord(upper)};
}

// Grids that paint the cube from -1 to 1 and a little more: "ramp" from 2 to 6 along x and "narrow" from 0.8
// to 1.6 along y, "paint" from 0 to 1 along x, "turn" directions around z.
inline void write_painted_grids(const std::string& file) {
  const openvdb::CoordBBox box = cube_of(-6, 6);
  using openvdb::FloatGrid;
  const auto single = [](double value) { return static_cast<float>(value); };
  write_vdb(file,
            {grid_of<FloatGrid>("ramp", 0.25, box,
                                [&](double x, double, double) { return single(4.0 + 4.0 / 3.0 * x); }),
             grid_of<FloatGrid>("narrow", 0.25, box,
                                [&](double, double y, double) { return single(1.2 + 0.25 * y); }),
             grid_of<FloatGrid>("paint", 0.25, box,
                                [&](double x, double, double) { return single(0.5 + x / 3.0); }),
             grid_of<openvdb::Vec3SGrid>(
                 "turn", 0.25, box,
                 [&](double x, double y, double) { return openvdb::Vec3s(single(-y), single(x), 0.1f); })},
            {});
}

}  // namespace solidnoise
