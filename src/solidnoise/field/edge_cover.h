#pragma once

#include <span>

#include <glm/vec3.hpp>

namespace solidnoise {

// A soft edge, as voxels hold it. At a place the edge is smoothstep(1/2 + level / width): levels are -width /
// 2 and less outside of it, width / 2 and more within. Where it is steeper than voxels can show, samples at
// their centres would be steps; so what a voxel gets is the mean over the two voxels about its centre along
// each axis, under a tent (the filter that linear interpolation is). From voxel to voxel that changes by a
// half at most, and it adds up to what the samples do. Means are of 4 x 4 x 4 places, at which levels and
// widths are interpolated.
//
// `level` and `width` are of a lattice of `count` samples and of one more all around; `cover` gets those of
// `count`. The last axis is the fastest.
void edge_cover(const glm::ivec3& count, std::span<const float> level, std::span<const float> width,
                std::span<float> cover);

}  // namespace solidnoise
