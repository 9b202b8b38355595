// All of the component geometry: polygon meshes and their files.
#pragma once

#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/polygon_mesh.h"
#include "solidnoise/geometry/texture_coordinates.h"
