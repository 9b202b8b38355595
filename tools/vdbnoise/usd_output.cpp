#include "vdbnoise/usd_output.h"

#include <filesystem>
#include <regex>

#include "common/outputs.h"
#include "common/run_tool.h"
#include "vdbnoise/nvdb_output.h"

namespace solidnoise {

void check_usd(const FlagSet& flags, const MakeOptions& options) {
  if (!options.usd) return;
  require_usd(options.out);
  if (is_nvdb(options))
    throw UsageError("--usd needs --out FILE.vdb; USD's volumes have no fields of .nvdb files");
  flags.refuse({"--skip-existing"}, "does not go with --usd, which needs the volumes that it describes");
}

std::string usd_scene_path(const std::string& out) {
  static const std::regex kFrameNumber("[._-]?(#+|%0?[0-9]*d)(?=[.][^.]*$)");
  return usd_path(std::regex_replace(out, kFrameNumber, ""));
}

void add_to_scene(UsdScene& scene, const MakeOptions& options, const Volume& volume) {
  const openvdb::GridCPtrVec grids = grids_of(volume);
  if (scene.frames.empty()) {
    scene.up = options.recipe.up;
    scene.fps = options.fps;
    scene.fields = usd_fields(grids);
  }
  scene.frames.push_back(
      {options.frame, std::filesystem::path(options.out).filename().string(), usd_extent(grids)});
}

void write_scene(const UsdScene& scene, const MakeOptions& options, OutputGroup* group) {
  const std::filesystem::path path = usd_scene_path(options.out);
  UsdScene named = scene;
  named.name = path.stem().string();
  write_text_file(path, named.text(), {.existing = options.existing(), .group = group});
}

}  // namespace solidnoise
