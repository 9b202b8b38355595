#pragma once

#include <string>

#include "solidnoise/volume/topology/fill.h"
#include "solidnoise/volume/volume.h"
#include "support/wave_field.h"

namespace solidnoise {

// A fog volume of waves in a ball.
inline openvdb::FloatGrid::Ptr wave_grid(double radius = 1.0) {
  const WaveField field(Vec<3>(1.0, 2.0, 3.0));
  const auto grid =
      fill_grid(sphere_topology(GridFrame(0.1), Vec<3>(0.0), radius), field, Sparsity::keep).grid;
  set_fog_volume(*grid, "density", "tests");
  return grid;
}

// Whether all voxels, active and not, are the same.
inline bool same_values(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  if (!a.tree().hasSameTopology(b.tree()) || a.background() != b.background()) return false;
  for (auto value = a.cbeginValueAll(); value; ++value) {
    if (b.tree().getValue(value.getCoord()) != *value) return false;
  }
  return true;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace solidnoise
