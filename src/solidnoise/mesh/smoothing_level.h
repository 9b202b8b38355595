#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {

// What heat flows through: places on a surface, of a mesh or coarser ones that stand for some of its points.
struct SmoothingLevel {
  Adjacency neighbours;
  std::vector<double> areas;
  std::vector<Vec<3>> positions;
  std::vector<Vec<3>> normals;
  // For each neighbour, in the order of the adjacency: what its line is to be multiplied with (transport();
  // of modulus 1 or, between clusters, less), and what flows per difference.
  std::vector<std::complex<float>> turns;
  std::vector<float> weights;
  double mean_edge = 0.0;  // world units; 0 without neighbours

  std::size_t size() const { return areas.size(); }
};

// The level of a mesh's points: the cotangent weights of Pinkall and Polthier 1993, negative ones taken as 0.
// Lines are carried between planes of these unit normals, one per point.
SmoothingLevel level_of_points(const SurfaceMesh& surface, std::span<const Vec<3>> normals);

// A coarser level, whose places are clusters of a finer one's: a point and what neighbours of it no earlier
// cluster has, of those between which heat flows well.
struct CoarserLevel {
  SmoothingLevel level;
  std::vector<std::uint32_t> cluster_of;   // of each place of the finer level
  Adjacency places;                        // of each cluster
  std::vector<std::complex<float>> turns;  // what the cluster's line is multiplied with at the place
};

// Heat flows from cluster to cluster as between those of the finer level's places that are neighbours across
// the border (Galerkin), and lines turn as they do on the mean of these ways: shorter where these disagree.
CoarserLevel make_coarser(const SmoothingLevel& fine);

}  // namespace solidnoise
