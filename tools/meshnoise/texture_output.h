#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "meshnoise/bake_options.h"
#include "solidnoise/core/output_file.h"
#include "solidnoise/core/progress.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/mesh/bake_textures.h"

namespace solidnoise {

// What --uv asks for, on one mesh.
struct TextureJob {
  TexturePlan plan;
  std::vector<TextureMap> maps;
};

// Refuses names of --uv and --map before any work: UsageError.
void check_textures(const BakeOptions& options);

// Plans the textures of a mesh, whose vertices stay as they are, whatever the recipe refines. Throws
// std::runtime_error naming the file: coordinates that are missing or out of range; what takes more memory or
// time than is allowed; textures that are there already.
TextureJob plan_texture_job(const std::string& in, const MeshReading& reading, const BakeOptions& options);

// Bakes all tiles, writes them with the group, and says so.
void write_textures(const TextureJob& job, const BakeOptions& options, Progress* progress,
                    OutputGroup* group);

// What --describe says of them.
nlohmann::json describe_textures(const TextureJob& job, const BakeOptions& options);

}  // namespace solidnoise
