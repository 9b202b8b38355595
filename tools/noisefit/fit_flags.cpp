#include "noisefit/fit_flags.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
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
  flags.integer(
      "--patch", unit,
      "Average over patches of this size; without it, as large as can be, of pictures above 384 pixels 256",
      [&](int size) {
        require_in_range("--patch", size, 16, 1 << 20);
        options.fit.patch = size;
      });
}

template <int Dim>
FitSize fit_size(const std::vector<Exemplar<Dim>>& exemplars, const FitOptions& options) {
  FitSize size;
  glm::vec<Dim, int> patch = exemplars.front().shape().count;
  for (const Exemplar<Dim>& exemplar : exemplars) {
    size.read += static_cast<double>(exemplar.channels.size() * exemplar.shape().size());
    patch = glm::min(patch, exemplar.shape().count);
  }
  if (Dim == 2 && options.fit.patch == 0) {
    for (int axis = 0; axis < Dim; ++axis) patch[axis] = patch[axis] > 384 ? 256 : patch[axis];
  }
  if (options.fit.patch > 0) patch = glm::min(patch, glm::vec<Dim, int>(options.fit.patch));
  const auto channels = static_cast<double>(exemplars.front().channels.size());
  size.fitted = channels;
  for (int axis = 0; axis < Dim; ++axis) size.fitted *= patch[axis];
  if (options.outputs.preview.empty()) return size;
  const auto shown = glm::min(exemplars.front().shape().count, glm::vec<Dim, int>(kLargestShown));
  size.drawn = channels * shown[0] * shown[1];
  return size;
}

// Measured on two cores with pictures of 64^2 to 4096^2 pixels, grey and in colour, and boxes of 32^3 to 96^3
// voxels: a fit takes 80 to 105 bytes of each sample, most where a core does each channel, and 15 to 35
// microseconds of one core, most where the spectrum is rich; the test for structure 52 bytes of a pixel, the
// sheet 115 of a sample.
void require_fit_cost(const FitOptions& options, const FitSize& size) {
  const double fit = 128.0 * size.fitted;
  const double test = 56.0 * size.tested;
  const double sheet = size.drawn > 0.0 ? 6.0 * 0x1p20 + 130.0 * size.drawn : 0.0;
  options.require_cost(fmt::format("{:.0f} samples", size.read),
                       {35e-6 * size.fitted + 1.2e-6 * size.read, size.held + std::max({fit, test, sheet})});
}

template FitSize fit_size(const std::vector<Exemplar<2>>&, const FitOptions&);
template FitSize fit_size(const std::vector<Exemplar<3>>&, const FitOptions&);

void parse_fit(FlagSet& flags, const std::vector<std::string>& arguments, FitOptions& options) {
  flags.footer("A Ctrl-C ends the fit early and keeps the last solution.");
  flags.parse(arguments);
  flags.explained([&] {
    flags.apply();
    options.fit.validate();
  });
  options.outputs.existing = options.existing();
}

}  // namespace solidnoise
