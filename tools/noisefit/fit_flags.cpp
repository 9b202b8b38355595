#include "noisefit/fit_flags.h"

#include <stdexcept>

#include "solidnoise/core/check.h"

namespace solidnoise {

void declare_output_flags(FlagSet& flags, FitOptions& options, const std::string& sheet) {
  flags.group("Flags");
  flags.keep("--out", "FILE.json", "Where the noise goes; - for the standard output", options.outputs.model);
  flags.keep("--preview", "FILE.png", sheet, options.outputs.preview);
  declare_fields(flags, options);
  declare_fields<RunOptions>(flags, options, {"force", "max_memory", "max_time", "quiet"});
}

void declare_patch_flag(FlagSet& flags, FitOptions& options, const std::string& unit) {
  flags.integer("--patch", unit, "Average over patches of this size; without it, as large as can be",
                [&](int size) {
                  require_in_range("--patch", size, 16, 1 << 20);
                  options.fit.patch = size;
                });
}

// Measured with pictures of 64^2 to 1024^2 pixels and boxes of 32^3 to 96^3 voxels: 105 to 120 bytes, and 15
// to 35 microseconds of one core, most where the spectrum is rich.
void require_fit_cost(const FitOptions& options, double samples) {
  constexpr double kProgramBytes = 140.0 * 0x1p20;  // most of it OpenImageIO
  constexpr double kBytesPerSample = 128.0;
  constexpr double kSecondsPerSample = 35e-6;
  options.require_cost(fmt::format("{:.0f} samples", samples),
                       {kProgramBytes + kBytesPerSample * samples, kSecondsPerSample * samples});
}

void parse_fit(FlagSet& flags, const std::vector<std::string>& arguments, FitOptions& options) {
  flags.footer("A Ctrl-C ends the fit early and keeps the last solution.");
  flags.parse(arguments);
  try {
    flags.apply();
    options.fit.validate();
  } catch (const std::invalid_argument& error) {
    throw UsageError(flags.name_flag(error.what()));
  }
  options.outputs.existing = options.existing();
}

}  // namespace solidnoise
