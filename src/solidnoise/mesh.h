// All of the component mesh: noise on meshes, ours or OpenMesh's of any kernel.
#pragma once

#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/mesh/bake_textures.h"
#include "solidnoise/mesh/curvature.h"
#include "solidnoise/mesh/displace.h"
#include "solidnoise/mesh/openmesh.h"
#include "solidnoise/mesh/refine.h"
#include "solidnoise/mesh/surface_field.h"
#include "solidnoise/mesh/texture_plan.h"
#include "solidnoise/mesh/vertex_colors.h"
