// All of the component render: pictures of meshes.
#pragma once

#include "solidnoise/render/render_mesh.h"
