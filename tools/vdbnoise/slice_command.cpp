#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/outputs.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/noise/interpolation/noise_cost.h"
#include "solidnoise/noise/registry/noise_recipe.h"
#include "solidnoise/volume/slice/slice_field.h"
#include "solidnoise/volume/slice/slice_image.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "solidnoise/volume/volume_cost.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/slice_options.h"
#include "vdbnoise/volume_flags.h"

namespace solidnoise {
namespace {

constexpr char kSliceDescription[] =
    "Makes a picture of a plane through a noise, through what a recipe makes volumes of, or through a grid "
    "of an OpenVDB file; or a line of samples.\n"
    "  vdbnoise slice --out noise.png\n"
    "  vdbnoise slice --dims 2 --period 2 2 0 --frequency 8 --out tile.png --spectrum spectrum.png\n"
    "  vdbnoise slice --preset fire --grid temperature --ramp 0:#000,.4:#a21,.75:#fb3,1:#fff --out fire.png\n"
    "  vdbnoise slice smoke.vdb --normal 1 0 0 --ramp viridis --out smoke.png\n"
    "  vdbnoise slice --dims 1 --out line.csv";

bool may_limit(VolumeRecipe grid) {
  grid.dims = std::max(grid.dims, 3);  // those of fewer may, too
  return may_band_limit(grid);
}

// Frequencies that the pixels cannot hold come back as others.
void warn_of_aliasing(const SliceOptions& options, const SliceField& field) {
  const double highest = field.highest_frequency * options.plane.pixel;
  const bool limited = options.file.empty() && options.recipe.band_limit;
  if (limited && field.sigma == 0.0 && !options.quiet) {
    std::cerr << "vdbnoise: warning: --band-limit leaves nothing of the noise, all of whose frequencies are "
                 "above what the pixels hold; make --frequency lower or --width smaller\n";
  }
  if (options.quiet || limited || highest <= 0.5) return;
  std::cerr << fmt::format(
      "vdbnoise: warning: the noise reaches {:.2f} cycles per pixel, above 0.5, and will alias; {}make "
      "--width "
      "smaller, --frequency lower or --resolution larger\n",
      highest, may_limit(sliced_grid(options)) ? "give --band-limit, or " : "");
}

// Evaluated pixel by pixel: what is interpolated takes less.
double seconds_of(const VolumeRecipe& grid, PointWork pixels) {
  if (grid.dims > 2) return seconds_at_points(grid, pixels);
  const double channels = is_scalar(grid) ? 1.0 : 3.0;
  if (std::get<RawShaping>(grid.shaping).normalize) pixels.points += kMostNormalizationSamples;
  return channels * (grid.dims == 1 ? cost_at_points(*make_noise<1>(grid.noise), pixels).seconds
                                    : cost_at_points(*make_noise<2>(grid.noise), pixels).seconds);
}

// The grid that is sliced; none where the file has no such grid: reading it says so.
std::optional<GridSummary> grid_to_slice(const SliceOptions& options) {
  for (const GridSummary& grid : read_vdb_summary(options.file).grids) {
    const bool can_be_sliced = grid.value_type == "float" || grid.value_type.starts_with("vec3");
    if (can_be_sliced && (options.grid.empty() || grid.name == options.grid)) return grid;
  }
  return std::nullopt;
}

// Measured on pictures of 4096^2 pixels: a sample takes 8 to 16 bytes with its picture's, in colour 20 to 50.
void require_cost(const SliceOptions& options) {
  constexpr double kProgramBytes = 54.0 * 0x1p20;
  constexpr double kPictureProgramBytes = 150.0 * 0x1p20;
  constexpr double kBytesPerSample = 16.0;
  constexpr double kBytesPerColor = 52.0;
  constexpr double kSecondsPerGridSample = 50e-9;
  constexpr double kSecondsPerPixel = 0.1e-6;  // of its picture
  constexpr double kProgramSeconds = 0.05;
  constexpr double kPictureProgramSeconds = 0.2;
  double bytes = options.line ? kProgramBytes : kPictureProgramBytes;
  const double pixels = static_cast<double>(options.plane.columns) * options.plane.rows;
  bool has_channels = options.color;
  double seconds = options.line ? kProgramSeconds : kPictureProgramSeconds;
  if (options.file.empty()) {
    VolumeRecipe grid = sliced_grid(options);
    if (options.color) grid.output = {Output::color};
    grid = at_resolution(grid, Vec<3>(options.plane.pixel));
    has_channels = grid.output != std::vector{Output::value};
    seconds += seconds_of(grid, {pixels, options.plane.pixel, options.line ? 1 : 2});
  } else if (const auto grid = grid_to_slice(options)) {
    bytes += memory_of(*grid);
    has_channels = grid->value_type != "float" && !options.component;
    seconds += (has_channels ? 3.0 : 1.0) * kSecondsPerGridSample * pixels;
  }
  const bool in_color = has_channels || !options.ramp.empty() || !options.spectrum.empty();
  options.require_cost(
      fmt::format("{} x {} pixels", options.plane.columns, options.plane.rows),
      {seconds + kSecondsPerPixel * pixels, bytes + pixels * (in_color ? kBytesPerColor : kBytesPerSample)});
}

// Beside the recipe's shape, or between its waves.
void warn_of_nothing(const SliceOptions& options, const std::vector<DenseField<2>>& channels) {
  if (options.quiet || !options.file.empty() || !is_bounded(options)) return;
  for (const DenseField<2>& channel : channels) {
    if (std::ranges::any_of(channel.values, [](float value) { return value != 0.0f; })) return;
  }
  std::cerr
      << "vdbnoise: warning: all pixels are 0: the recipe has nothing there; move the plane by --origin\n";
}

void write_slice(const SliceOptions& options, const SliceField& field,
                 const std::vector<DenseField<2>>& channels) {
  const DenseField<2>& slice = channels.front();
  if (options.line) {
    return write_text_file(options.out, line_table(options.plane, slice), {.existing = options.existing()});
  }
  OutputGroup outputs;
  ImageFileOptions file{.existing = options.existing(), .group = &outputs};
  const auto form_of = [&](const std::string& path) {
    const bool floats = extension_of(path) == ".exr";
    file.color_space = floats ? ColorSpace::linear : ColorSpace::srgb;
    return floats ? PixelForm::values : PixelForm::shown;
  };
  if (!options.spectrum.empty()) {
    const Image spectrum = spectrum_image(options, slice, form_of(options.spectrum));
    write_image(options.spectrum, spectrum, file);
  }
  if (options.out.empty()) return outputs.appear();
  const auto shown = shown_values(options, field, channels);
  const PixelForm form = form_of(options.out);
  file.sample_type = options.sample_type;
  write_image(options.out,
              channels.size() > 1 ? color_image(field, channels, shown, form)
                                  : slice_image(options, slice, shown, form),
              file);
  outputs.appear();
}

void make_slice(SliceOptions options) {
  require_outputs({options.out, options.spectrum}, options.existing(),
                  {options.file, options.inputs.recipe, options.inputs.noise});
  catch_interrupts();
  const auto threads = options.limit_threads();
  auto ends_at_once = std::make_unique<EndsAtOnce>();
  require_cost(options);
  const SliceField field = make_slice_field(options);
  if (field.bounds) fit_plane(options, *field.bounds, options.plane);
  if (field.source->channels() > 1 && (!options.ramp.empty() || !options.spectrum.empty() || options.line)) {
    throw UsageError(
        "--ramp, --spectrum and a line have one value for each pixel; --component says which of the "
        "vectors'");
  }
  if (options.values && field.exemplar) {
    throw UsageError("--values has no effect on the colours of an exemplar");
  }
  warn_of_aliasing(options, field);
  std::vector<DenseField<2>> channels;
  {
    TaskProgress progress(options.visibility());
    progress.begin("slice");
    channels = sample_slice(*field.source, options.plane, &progress);
    for (const DenseField<2>& channel : channels) {
      if (std::isfinite(Moments::of(channel.values).sigma())) continue;
      throw std::runtime_error((options.file.empty() ? "the recipe" : options.file) +
                               ": has values that are not finite in the slice");
    }
    ends_at_once.reset();
    throw_if_cancelled(&progress);
    warn_of_nothing(options, channels);
    write_slice(options, field, channels);
  }
  if (options.quiet) return;
  std::cerr << fmt::format("{}: {} x {} samples, {:.6g} world units apart\n",
                           options.out.empty() ? options.spectrum : options.out, channels.front().count.x,
                           channels.front().count.y, options.plane.pixel);
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const Moments moments = Moments::of(channels[k].values);
    const std::string name = channels.size() > 1 ? fmt::format("channel {}: ", k) : std::string();
    std::cerr << fmt::format("{}min {:.6g}  max {:.6g}  mean {:.6g}  sigma {:.6g}\n", name, moments.min(),
                             moments.max(), moments.mean(), moments.sigma());
  }
}

}  // namespace

int run_slice(const std::vector<std::string>& arguments) {
  SliceOptions options;
  FlagSet flags("vdbnoise slice", kSliceDescription);
  const std::vector<std::string> noise_flags = declare_slice_flags(flags, options);
  flags.parse(arguments);
  options.recipe = choose_volume_recipe(flags, "raw");
  options.inputs = recipe_inputs(flags);
  explained(flags, [&] {
    flags.apply();
    if (!options.recipe.grids.empty()) {
      flags.refuse({"--raw", "--fold", "--histogram", "--warp"},
                   "has no effect where the recipe makes several grids, each with its own");
    }
    check_layer_flags(flags, options.recipe, noise_flags);
    check_slice_options(flags, options, noise_flags);
    make_slice(options);
  });
  return kDone;
}

}  // namespace solidnoise
