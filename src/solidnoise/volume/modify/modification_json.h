#pragma once

#include <optional>

#include "solidnoise/recipe/json.h"
#include "solidnoise/recipe/json_reader.h"
#include "solidnoise/volume/modify/modification.h"
#include "solidnoise/volume/volume_fields.h"

namespace solidnoise {

// The keys that a modification adds to a recipe:
//   "on": {"file": "smoke.vdb", "grid": "density"}, "combine": "erode", "amount": 0.5
// and, instead of the last two, "displace": 0.1; "mask" and "rest" as "on". Of these keys all may be left
// out, even "on", which is then to be named before the recipe can be made.
void add_modification(Json& recipe, const Modification& modification);

// Reads them; there is a modification if one of them is there. Throws std::invalid_argument with the path in
// the tree.
void read_modification(JsonReader& reader, std::optional<Modification>& modification);

}  // namespace solidnoise
