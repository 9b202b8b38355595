#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_options.h"
#include "common/run_tool.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/merge_files.h"
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
  RunOptions options;
  FlagSet flags("vdbnoise merge", kMergeDescription);
  flags.arguments("FILE...", "The parts, in any order", files);
  flags.keep("--out", "FILE.vdb", "Where the grid goes; - for the standard output", out);
  flags.keep("--preview", "FILE.png", "A picture of the volume, rendered by OpenVDB", preview);
  declare_fields(flags, options, {"force", "max_memory", "max_time", "quiet"});
  flags.parse(arguments);
  flags.apply();
  if (out.empty()) throw UsageError("--out is missing; say where the grid goes: --out whole.vdb");
  check_output_names(out, preview);
  require_outputs({out, preview}, options.existing(), files);
  catch_interrupts();
  merge_files(files, out, preview, options);
  return kDone;
}

}  // namespace solidnoise
