#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// A grid of a .vdb, as UsdVol's OpenVDBAsset describes it.
struct UsdField {
  std::string grid;
  std::string field_class;  // fogVolume, levelSet, staggered, unknown
  std::string data_type;    // float, float3, ...; empty: one that UsdVol has no word for
  std::string vector_role;  // Vector, Normal, Point, Color; empty: no vectors
};

// A .vdb, and the number of its frame.
struct UsdFrame {
  std::optional<int> frame;
  std::string file;         // relative to the scene's
  openvdb::BBoxd extent{};  // of the active voxels, world units
};

// A volume as a scene: metres, its up axis, a prim Volume whose fields are grids of .vdb files.
struct UsdScene {
  std::string name;  // of the prim
  UpAxis up = UpAxis::y;
  double fps = 24.0;
  std::vector<UsdField> fields;
  std::vector<UsdFrame> frames;  // one without a number, or several with theirs

  // The scene as .usda. Throws std::invalid_argument where two grids have one name in USD.
  std::string text() const;
};

// What a scene says of grids.
std::vector<UsdField> usd_fields(const openvdb::GridCPtrVec& grids);
openvdb::BBoxd usd_extent(const openvdb::GridCPtrVec& grids);

}  // namespace solidnoise
