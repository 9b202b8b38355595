#include <memory>
#include <optional>
#include <stdexcept>

#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_options.h"
#include "common/run_tool.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/preview/picture.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

constexpr char kMergeDescription[] =
    "Joins the parts of a volume, made by --shard or --region, to what vdbnoise makes of the recipe in one\n"
    "piece, bit for bit.\n"
    "  vdbnoise merge part1.vdb part2.vdb --out whole.vdb";

}  // namespace

int run_merge(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  std::string out;
  std::string preview;
  VdbWriteOptions write;
  RunOptions options;
  FlagSet flags("vdbnoise merge", kMergeDescription);
  flags.arguments("FILE...", "The parts, in any order", files);
  flags.keep("--out", "FILE.vdb", "Where the grid goes; - for the standard output", out);
  flags.keep("--preview", "FILE.png", "A picture of the volume, rendered by OpenVDB", preview);
  declare_fields(flags, options, {"force", "quiet"});
  flags.parse(arguments);
  flags.apply();
  write.existing = options.existing();
  if (out.empty()) throw UsageError("--out is missing; say where the grid goes: --out whole.vdb");
  check_output_names(out, preview);
  require_outputs({out, preview}, write.existing, files);
  catch_interrupts();

  MergedVolume merged;
  {
    TaskProgress progress(options.visibility());
    auto ends_at_once = std::make_unique<EndsAtOnce>();
    progress.begin("merging");
    merged = merge_parts({files.begin(), files.end()}, kVdbnoise, &progress);
    std::optional<Image> picture;
    if (!preview.empty()) {
      progress.begin("preview");
      picture = picture_of(merged.volume, merged.recipe, nullptr, &progress);
    }
    progress.begin("writing");
    ends_at_once.reset();
    write.codec = merged.recipe.codec;
    write.creator = kVdbnoise;
    write.frame = merged.frame;
    write.fps = merged.fps;
    write.progress = &progress;
    OutputGroup outputs;
    write.group = &outputs;
    if (picture) write_image(preview, *picture, {.existing = write.existing, .group = &outputs});
    write_volume(out, merged.volume, write);
    outputs.appear();
  }
  if (!options.quiet) print_statistics(merged.volume, out);
  return kDone;
}

}  // namespace solidnoise
