#pragma once

#include <vector>

#include "solidnoise/core/choices.h"
#include "solidnoise/field/layer.h"
#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"

namespace solidnoise {

inline constexpr Choices<Layer::Fold, 4> kLayerFoldChoices{{
    {Layer::Fold::none, "none"},
    {Layer::Fold::ridged, "ridged"},
    {Layer::Fold::billow, "billow"},
    {Layer::Fold::turbulence, "turbulence"},
}};

inline constexpr Choices<Layer::Histogram, 2> kHistogramChoices{{
    {Layer::Histogram::gaussian, "gaussian"},
    {Layer::Histogram::uniform, "uniform"},
}};

inline constexpr Choices<Layer::Combine, 5> kLayerCombineChoices{{
    {Layer::Combine::sum, "sum"},
    {Layer::Combine::product, "product"},
    {Layer::Combine::max, "max"},
    {Layer::Combine::min, "min"},
    {Layer::Combine::mix, "mix"},
}};

// The key "layers" of a recipe or a layer:
//   "layers": [
//     {"noise": {"type": "gabor", ...}, "fold": "ridged", "histogram": "gaussian", "weight": 0.5, "bias": 0,
//      "warp": {"amount": 0.2, "noise": {...}}},
//     {"combine": "max", "layers": [...], "ramp": [[-1, 0], [2, 1]]}
//   ]
// Every key may be left out. Without layers the key is not written.
void add_layers(Json& object, const std::vector<Layer>& layers);

// Throws std::invalid_argument with the path in the tree: wrong type, unknown key, too many or too deep. What
// validate_layers() checks beyond a single value is left to it.
void read_layers(JsonReader& reader, std::vector<Layer>& layers);

}  // namespace solidnoise
