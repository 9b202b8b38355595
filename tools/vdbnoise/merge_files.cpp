#include "vdbnoise/merge_files.h"

#include <filesystem>
#include <memory>
#include <optional>

#include "common/run_tool.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/preview/picture.h"
#include "solidnoise/volume/volume_cost.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

// What a picture is made of, and what goes through a pipe, is there all at once.
MergedVolume merge_in_memory(const std::vector<std::filesystem::path>& files, const std::string& out,
                             const std::string& preview, VdbWriteOptions write) {
  auto ends_at_once = std::make_unique<EndsAtOnce>();
  MergedVolume merged = merge_parts(files, kVdbnoise, write.progress);
  std::optional<Image> picture;
  if (!preview.empty()) picture = picture_of(merged.volume, merged.recipe, nullptr, write.progress);
  ends_at_once.reset();
  OutputGroup outputs;
  write.codec = merged.recipe.codec;
  write.frame = merged.frame;
  write.fps = merged.fps;
  write.group = &outputs;
  if (picture) write_image(preview, *picture, {.existing = write.existing, .group = &outputs});
  write_volume(out, merged.volume, write);
  outputs.appear();
  return merged;
}

}  // namespace

void merge_files(const std::vector<std::string>& parts, const std::string& out, const std::string& preview,
                 const RunOptions& options) {
  const std::vector<std::filesystem::path> files(parts.begin(), parts.end());
  MergedVolume merged;
  {
    TaskProgress progress(options.visibility());
    VdbWriteOptions write;
    write.existing = options.existing();
    write.creator = kVdbnoise;
    write.progress = &progress;
    progress.begin("merging");
    const bool streams = out != "-" && preview.empty() && may_stream_parts(files);
    const Cost cost = merge_cost(files, streams ? Making::streamed : Making::in_memory,
                                 preview.empty() ? Target::file : Target::picture);
    options.require_cost("merging", cost);
    merged = streams ? merge_parts_to_file(files, out, write) : merge_in_memory(files, out, preview, write);
  }
  if (!options.quiet) print_statistics(merged.volume, out);
}

}  // namespace solidnoise
