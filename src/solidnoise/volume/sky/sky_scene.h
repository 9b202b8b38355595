#pragma once

#include <string>
#include <vector>

#include "solidnoise/volume/sky/sky_plan.h"

namespace solidnoise {

// A sky as .usda: metres, its up axis, a prim Xform for each point, which is an instance of its cloud, moved,
// turned and scaled. `scenes` are the clouds' own (UsdScene), one of each, relative to this one.
std::string sky_scene_text(const SkyPlan& plan, const std::string& name,
                           const std::vector<std::string>& scenes);

}  // namespace solidnoise
