#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <glm/common.hpp>

#include "solidnoise/field/cloud_field.h"
#include "solidnoise/field/cloud_puffs.h"

namespace solidnoise {

// A cloud as its evaluation needs it, made once. Lengths in world units.
struct CloudModel {
  CloudShaping shaping;
  std::vector<Octave> octaves;
  std::vector<float> depths;  // of each octave's lobes
  // How far the surface may still move outward and inward from octave k on; 0 after the last one.
  std::vector<float> outward;
  std::vector<float> inward;
  float edge = 0.0f;         // least width of the soft edge
  float widest_edge = 0.0f;  // greatest one
  float foot = 0.0f;         // height over which lobes grow to their full depth
  float core_depth = 0.0f;   // at which the core is densest
  float floor_rounding = 0.0f;
  std::array<float, 2> walls{};  // half extents of the room above the ground; all of it is within
  float roof = 0.0f;             // height of the top of the room
  float cellar = 0.0f;           // depth of the room below the ground
  Vec<3> ground{0.0};            // where the cloud's frame has its origin
  UpAxis up = UpAxis::y;
  PuffUnion pile{{}, 1.0};
  Vec<3> voxel{0.0};

  // Of all that a box's samples depend on.
  Box<3> with_neighbours(const Box<3>& world) const { return {world.lower - voxel, world.upper + voxel}; }

  // From the world to the cloud's own frame, in which y is up.
  Vec<3> to_cloud(const Vec<3>& world) const {
    const Vec<3> p = world - ground;
    return up == UpAxis::y ? p : Vec<3>(p.x, p.z, -p.y);
  }
  Box<3> to_cloud(const Box<3>& world) const {
    const Vec<3> a = to_cloud(world.lower);
    const Vec<3> b = to_cloud(world.upper);
    return {glm::min(a, b), glm::max(a, b)};
  }
};

CloudModel make_cloud_model(const CloudParts& parts);

// The edge of a cloud at some samples, see edge_cover(), and the density that there is within.
struct CloudEdge {
  std::vector<float> level;
  std::vector<float> width;
  std::vector<float> within;
};

// Writes octave k of those groups of samples that are wanted, one after the other.
using OctaveValues =
    std::function<void(std::size_t k, std::span<const std::size_t> wanted, std::span<float> values)>;

// The edges at groups of samples (lattices, or points), all of one cloud and one pile. `positions` has those
// of `groups` groups of one size, one after the other.
std::vector<CloudEdge> cloud_edges(const CloudModel& model, const PuffUnion& pile,
                                   std::span<const Vec<3>> positions, std::size_t groups,
                                   const OctaveValues& noise);

}  // namespace solidnoise
