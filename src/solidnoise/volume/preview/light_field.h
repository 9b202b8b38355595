#pragma once

#include <functional>
#include <vector>

#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// What light meets at a place of a volume.
struct Matter {
  double extinction = 0.0;                    // per world unit
  openvdb::Vec3d emission = {0.0, 0.0, 0.0};  // linear light per world unit
};

// A function from index space; one for each thread, for it may keep accessors.
using MatterAt = std::function<Matter(const openvdb::Vec3d& index)>;
using MakeMatter = std::function<MatterAt()>;

// Cubic cells over a box in index space, each with some light at its centre, which is interpolated between.
class LightCells {
 public:
  // As many as `most` along the longest side of the box.
  LightCells(const openvdb::CoordBBox& box, int most);

  double size() const { return size_; }  // of a cell, voxels
  const openvdb::Coord& count() const { return count_; }
  bool contains(const openvdb::Coord& cell) const;
  openvdb::Vec3d centre(const openvdb::Coord& cell) const;
  openvdb::Vec3f& operator[](const openvdb::Coord& cell) { return light_[index(cell)]; }
  openvdb::Vec3d at(const openvdb::Vec3d& index) const;

  // Their means of matter, each from eight places.
  std::vector<Matter> gather(const MakeMatter& make_matter) const;
  std::size_t index(const openvdb::Coord& cell) const;  // of it in what gather() returns

 private:
  openvdb::Vec3d lower_;
  double size_;
  openvdb::Coord count_;
  std::vector<openvdb::Vec3f> light_;
};

// Light from far away, of which matter takes its share, and more of it goes on, scattered forward.
struct Sun {
  openvdb::Vec3d direction;  // towards it, in index space, of length 1
  openvdb::Vec3d colour;     // linear light
  double lost = 0.5;         // of what matter takes, 0 to 1
};

// What lights the matter of a volume: suns behind what is before them, and what glows in the volume itself,
// all around.
class LightField {
 public:
  // Of a box in index space, of voxels of this size in world units.
  LightField(const openvdb::CoordBBox& box, double voxel, const std::vector<Sun>& suns,
             const MakeMatter& make_matter);

  openvdb::Vec3d at(const openvdb::Vec3d& index) const { return sun_.at(index) + glow_.at(index); }

 private:
  LightCells sun_;
  LightCells glow_;
};

}  // namespace solidnoise
