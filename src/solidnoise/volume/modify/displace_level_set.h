#pragma once

#include <cstdint>

#include "solidnoise/core/field.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// Moves the surface of a level set along its normals: the point p to p + amount n(p) normal(p), outwards
// where amount n > 0. `amount` is in world units. What is made is again a distance field in a band of the
// same half-width, with the level set's frame, name, class and metadata.
//
// At a voxel x whose closest point on the surface is p(x), at the signed distance s(x),
//   phi'(x) = s(x) - amount n(p(x)),
// the same along each normal, so that detail does not smear across the band. The zeros of phi' are the moved
// surface as long as it stays nearer to the old one than that bends (its radius of curvature) or than another
// part of it is: further out, parts meet and merge. phi' is made where the moved surface is, however far
// outside of the band; the new band's distances are those to the closest points on its zeros, normalized by
// OpenVDB's LevelSetTracker.
//
// In parallel; the same to the last bit for any number of threads. Throws std::invalid_argument if the grid's
// class is not level set, its voxels are not cubes, its background is not greater than 0 or it has no surface
// or values that are not finite; Cancelled. Progress is told from one thread, and is an estimate; it is asked
// many times a second whether to stop.
openvdb::FloatGrid::Ptr displace_level_set(const openvdb::FloatGrid& level_set, const Field<3>& noise,
                                           double amount, Progress* progress = nullptr);

// Voxels of the moved band, about, of a surface of area A that noise of unit variance and `frequency` f
// (cycles per world unit) moves by `amount` a a sigma, to either side. A grows with the square of 1 + 2 a /
// sqrt(A / 4 pi) and as a graph of such a noise does: by E sqrt(1 + |g|^2), about sqrt(1 + pi / 4 E|g|^2),
// where E|g|^2 = 2/3 (2 pi f a)^2 is its slope along the surface; where waves are near, their bands share the
// room that they sweep. Measured on a torus, moved by .002 to .1 of its radii in waves of .2 to .016 of them:
// .9 to 1.6 of the voxels that are made; moved by .5: 1.4 to 2.4.
double estimate_displaced_voxels(const openvdb::FloatGrid& level_set, double amount, double frequency);

// Bytes that this takes at most, beside the level set itself.
std::uint64_t estimate_displacement_memory(const openvdb::FloatGrid& level_set, double amount,
                                           double frequency);

}  // namespace solidnoise
