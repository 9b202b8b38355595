#pragma once

#include <filesystem>
#include <vector>

#include "solidnoise/core/output_file.h"
#include "solidnoise/volume/vdb/openvdb.h"

namespace solidnoise {

// How a .nvdb stores the values of grids of floats; those of vectors are always floats.
enum class NvdbValues { floats, bits16, bits8, bits4 };

struct NvdbWriteOptions {
  NvdbValues values = NvdbValues::floats;
  Existing existing = Existing::refuse;
  Progress* progress = nullptr;  // asked for cancellation while writing
  OutputGroup* group = nullptr;  // with which the file appears
};

// Writes grids of floats or vec3s as NanoVDB, version 32, uncompressed, as renderers on graphics cards take
// it into their memory; all or nothing, as write_output does. Names, classes and transforms are kept, other
// metadata is not: the format has no place for it.
//
// For each grid, the largest difference of an active voxel's stored value from what it was. Of n bits it is
// at most half a step, and the rounding of floats: 2^n - 1 steps are from the least to the greatest value of
// each leaf of 8^3 voxels, inactive ones included.
//
// Throws std::runtime_error naming the path and the grid for other types, names of more than 255 bytes and
// transforms that are not affine; OutputExists, Cancelled.
std::vector<double> write_nvdb(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                               const NvdbWriteOptions& options);

}  // namespace solidnoise
