#pragma once

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "solidnoise/volume/vdb/vdb_read.h"

namespace solidnoise {

// What the grid itself says: whether its values may be loaded later is a matter of the file, not of the grid.
inline std::map<std::string, std::string> grid_metadata(const VdbSummary& summary) {
  std::map<std::string, std::string> metadata = summary.grids[0].metadata;
  metadata.erase("file_delayed_load");
  return metadata;
}

inline bool same_values(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  if (!a.tree().hasSameTopology(b.tree()) || a.transform() != b.transform()) return false;
  for (auto value = a.cbeginValueOn(); value; ++value) {
    if (*value != b.tree().getValue(value.getCoord())) return false;
  }
  return true;
}

inline bool same_values(const std::string& one, const std::string& other) {
  return same_values(*read_float_grid(one), *read_float_grid(other));
}

// Topology, values and metadata, to the last bit.
inline void expect_same_grid(const std::string& one, const std::string& other) {
  EXPECT_TRUE(same_values(one, other));
  const VdbSummary a = read_vdb_summary(one);
  const VdbSummary b = read_vdb_summary(other);
  EXPECT_EQ(a.metadata, b.metadata);
  EXPECT_EQ(grid_metadata(a), grid_metadata(b));
}

}  // namespace solidnoise
