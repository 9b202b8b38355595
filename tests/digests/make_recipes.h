#pragma once

#include <filesystem>
#include <memory>

#include "digests/digest.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/noise/noise.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// All that the cases of JSON ask of the library: a recipe's values are made as its tools make them.

// A noise as it is at a time.
template <int Dim>
std::shared_ptr<const Noise<Dim>> noise_of(const Json& noise, double time = 0.0);
// The same, a quarter of a wave behind; Dim is 2 to 4.
template <int Dim>
std::shared_ptr<const Noise<Dim>> quadrature_of(const Json& noise);

void add_volume(const Json& recipe, Digest& digest);
// The same values, made in three parts that are written to the folder and merged.
void add_merged_volume(const Json& recipe, const std::filesystem::path& folder, Digest& digest);
// What densities are scaled by, measured slab by slab.
void add_density_factor(const Json& recipe, Digest& digest);
// Raw noise at scattered positions.
void add_volume_points(const Json& recipe, Digest& digest);

void add_bake(const Json& recipe, const PolygonMesh& mesh, Digest& digest);

}  // namespace solidnoise
