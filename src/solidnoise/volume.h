// All of the component volume: recipes of OpenVDB grids, made, modified, merged, described, measured and
// pictured, and their files.
#pragma once

#include "solidnoise/volume/analyze_volume.h"
#include "solidnoise/volume/describe_volume.h"
#include "solidnoise/volume/finish_volume.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/modified_volume.h"
#include "solidnoise/volume/preview/picture.h"
#include "solidnoise/volume/slice/slice_field.h"
#include "solidnoise/volume/slice/slice_image.h"
#include "solidnoise/volume/slice/slice_view.h"
#include "solidnoise/volume/stored_recipe.h"
#include "solidnoise/volume/stream_volume.h"
#include "solidnoise/volume/topology/mesh_level_set.h"
#include "solidnoise/volume/usd_scene.h"
#include "solidnoise/volume/vdb/nvdb_write.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/vdb/vdb_write.h"
#include "solidnoise/volume/volume_recipe.h"
#include "solidnoise/volume/volume_recipe_json.h"
