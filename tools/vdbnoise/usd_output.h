#pragma once

#include <string>

#include "common/flag_set.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/volume/usd_scene.h"
#include "solidnoise/volume/volume.h"
#include "vdbnoise/make_options.h"

namespace solidnoise {

// Refuses --usd where there is no .vdb to point to. Throws UsageError.
void check_usd(const FlagSet& flags, const MakeOptions& options);

// The scene's file: "cloud.usda" of cloud.vdb, of cloud.####.vdb and of cloud.%04d.vdb.
std::string usd_scene_path(const std::string& out);

// Adds a volume that has been made to a scene: one, or a frame of several.
void add_to_scene(UsdScene& scene, const MakeOptions& options, const Volume& volume);

// Writes the scene beside --out of the whole run.
void write_scene(const UsdScene& scene, const MakeOptions& options, OutputGroup* group);

}  // namespace solidnoise
