#pragma once

#include <cstddef>
#include <vector>

#include "solidnoise/mesh/refine.h"

namespace solidnoise {

// refine() and subdivide() by OpenMesh's subdividers, of a method that is not our own. `targets` has a length
// for every vertex. OpenMesh's adaptive subdividers are left aside: they know no lengths of edges, only faces
// to split.
RefinedMesh refine_by_openmesh(const PolygonMesh& mesh, const std::vector<double>& targets,
                               const RefineOptions& options);
RefinedMesh subdivide_by_openmesh(const PolygonMesh& mesh, int rounds, const RefineOptions& options);

// Throws std::invalid_argument if a refined mesh may not have as many vertices.
void require_vertices(std::size_t count, const RefineOptions& options);

}  // namespace solidnoise
