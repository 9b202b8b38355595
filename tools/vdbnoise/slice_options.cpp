#include "vdbnoise/slice_options.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/field_flags.h"
#include "common/noise_flags.h"
#include "common/outputs.h"
#include "common/recipe_files.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/image/color.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "vdbnoise/volume_flags.h"

namespace solidnoise {
namespace {

constexpr int kMostPixels = 16384;  // along a side

void declare_output(FlagSet& flags, SliceOptions& options) {
  flags.group("Output");
  flags.keep("--out", "FILE",
             ".png: 8 bits, or 16 with --bits; .exr: the values themselves, as floats; .csv: a line of "
             "samples",
             options.out);
  flags.choice("--bits", {"8", "16"}, "Of each channel of a .png (default 8)", [&](std::size_t index) {
    options.sample_type = index == 0 ? SampleType::uint8 : SampleType::uint16;
  });
  flags.numbers(
      "--values", "LOW HIGH",
      "The values that are black and white, or the ends of the ramp (default: 3 sigmas of the noise "
      "to each side; of a grid, the least and the greatest of the slice)",
      [&](const std::vector<double>& v) {
        if (v[0] >= v[1]) {
          throw UsageError(fmt::format("--values is {} {}; the first must be below the second", v[0], v[1]));
        }
        options.values.emplace(v[0], v[1]);
      });
  flags
      .text("--ramp", "RAMP",
            fmt::format("Colours: {}, or stops such as 0:#000,1:#fff (default: grey, the pixel's number "
                        "proportional to the value)",
                        fmt::join(ramp_names(), ", ")),
            [&](const std::string& text) {
              parse_color_ramp(text);
              options.ramp = text;
            })
      .words = ramp_names();
  flags.toggle(
      "--color",
      "Of a noise by example in colour its colours; of others three independent noises, one for each of "
      "red, green and blue",
      [&] { options.color = true; });
  flags.exclude({"--color", "--ramp"});
  flags.exclude({"--color", "--spectrum"});
  flags.keep("--spectrum", "FILE",
             "The slice's periodogram, frequency 0 in the middle, half a cycle per pixel at the edges: .png, "
             "or .exr for the densities themselves",
             options.spectrum);
  flags.choice("--spectrum-scale", {"log", "linear"},
               "Of a .png: 60 dB below the greatest density to it, or 0 to it (default log)",
               [&](std::size_t index) {
                 options.spectrum_scale = index == 0 ? SliceOptions::SpectrumScale::logarithmic
                                                     : SliceOptions::SpectrumScale::linear;
               });
  declare_fields<RunOptions>(flags, options, {"force"});
}

void declare_source(FlagSet& flags, SliceOptions& options) {
  flags.group("What is sliced");
  flags.keep("--grid", "NAME", "The grid of FILE.vdb, or of the recipe (default: the first one that can be)",
             options.grid);
  flags.choice("--component", {"x", "y", "z", "length"}, "Of vectors; without it, all three as colours",
               [&](std::size_t index) { options.component = Component(index); });
  flags.add({"--preset", "NAME", "Start from a recipe that comes with the program (default raw)"}).words =
      preset_names();
  flags.add(
      {"--recipe", "FILE",
       "Start from a recipe, .json, - for the standard input, from a link of the studio, or from that of a "
       ".vdb made by vdbnoise"});
  flags.exclude({"--preset", "--recipe"});
  flags.toggle("--raw", "The recipe's noise itself, without its shaping",
               [&] { options.recipe.shaping = RawShaping{}; });
  static const RawShaping kRaw{};
  declare_field(flags, kRaw, "normalize", [&](bool normalize) {
    auto* const raw = std::get_if<RawShaping>(&options.recipe.shaping);
    if (!raw) throw UsageError("--normalize applies to raw noise; give --raw too");
    raw->normalize = normalize;
  });
}

void declare_plane(FlagSet& flags, SliceOptions& options) {
  flags.group("Plane");
  const auto vector = [&](const char* flag, const char* names, const char* help,
                          std::optional<Vec<3>>& target) {
    flags.add({flag, names, help,
               [flag, &target](const FlagTexts& texts) { target = FlagForm<Vec<3>>::read(flag, texts); }});
  };
  vector("--origin", "X [Y Z]",
         "The middle of the picture, world units (default 0 0 0, or the middle of the grid or the box)",
         options.origin);
  vector("--normal", "X Y Z", "Across the plane, towards the viewer (default 0 0 1)", options.normal);
  vector("--up", "X Y Z", "What is up in the picture, as far as the plane allows (default 0 1 0)",
         options.up);
  flags.numbers("--axes", "X Y Z X Y Z", "Instead of both: what is right and what is up",
                [&](const std::vector<double>& v) {
                  try {
                    options.plane.span({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
                  } catch (const std::invalid_argument& error) {
                    throw UsageError(fmt::format("--axes is {:g}: {}", fmt::join(v, " "), error.what()));
                  }
                });
  flags.exclude({"--axes", "--normal"});
  flags.exclude({"--axes", "--up"});
  flags.number("--width", "UNITS",
               "Of the picture, world units (default 2, the period, or what holds the grid or the box)",
               [&](double width) {
                 require_positive("--width", width, "world units");
                 options.width = width;
               });
  flags.numbers("--resolution", "COLUMNS [ROWS]", "In pixels, which are square (default 512, as many rows)",
                [&](const std::vector<double>& v) {
                  for (const double side : v) {
                    require_in_range("--resolution", side, 1, kMostPixels, "pixels");
                    if (side != std::floor(side)) {
                      throw UsageError(fmt::format("--resolution is {}; it must be whole numbers", side));
                    }
                  }
                  options.plane.columns = static_cast<int>(v[0]);
                  options.plane.rows = static_cast<int>(v.back());
                });
}

void check_outputs(const SliceOptions& options) {
  if (options.out.empty() && options.spectrum.empty()) {
    throw UsageError("--out is missing; say where the picture goes: --out noise.png");
  }
  require_extension("--out", options.out, {".png", ".exr", ".csv"}, StandardOutput::refused);
  require_extension("--spectrum", options.spectrum, {".png", ".exr"}, StandardOutput::refused);
  if (options.sample_type != SampleType::automatic && extension_of(options.out) != ".png") {
    throw UsageError("--bits applies to --out FILE.png only");
  }
}

void check_line(const FlagSet& flags, const SliceOptions& options) {
  const bool of_one_dimension = options.file.empty() && options.recipe.dims == 1;
  if (of_one_dimension && !options.is_line()) {
    throw UsageError("--dims is 1; a noise on a line is written to --out FILE.csv");
  }
  if (!options.is_line()) return;
  flags.refuse({"--spectrum", "--ramp", "--values", "--color"}, "has no effect on a line");
}

// What the noise of a recipe would be given for nothing where a grid is sliced.
void check_file(const FlagSet& flags, const SliceOptions& options,
                const std::vector<std::string>& noise_flags) {
  if (options.file.empty()) return;
  const std::string why = fmt::format("has no effect where {} is sliced", options.file);
  for (const std::string& flag : noise_flags) flags.refuse({flag}, why);
  flags.refuse(
      {"--preset", "--recipe", "--raw", "--normalize", "--offset", "--band-limit", "--exact", "--evolve",
       "--dims", "--time", "--loop", "--wind", "--generator", "--fold", "--histogram", "--warp", "--color"},
      why);
}

void check_recipe(const SliceOptions& options) {
  const VolumeRecipe& recipe = options.recipe;
  VolumeRecipe checked = recipe;
  checked.dims = std::max(recipe.dims, 3);
  checked.validate();
  require_sliceable(options);
}

}  // namespace

std::vector<std::string> declare_slice_flags(FlagSet& flags, SliceOptions& options) {
  VolumeRecipe& recipe = options.recipe;
  flags.show_first({"--out", "--grid", "--noise", "--frequency", "--dims", "--normal", "--width",
                    "--resolution", "--ramp", "--spectrum"});
  flags.optional_argument("FILE.vdb", "A volume whose grid is sliced, instead of a recipe", options.file);
  declare_output(flags, options);
  declare_source(flags, options);
  flags.group("Noise");
  const std::vector<std::string> noise_flags = declare_noise_flags(flags, recipe.noise);
  declare_fields(flags, recipe, {"offset", "band_limit", "exact"});
  flags.group("Time");
  flags.integer("--dims", "1|2|3|4", "Dimensions of the noise (default 3)", [&](int dims) {
    require_in_range("--dims", dims, 1, 4);
    recipe.dims = dims;
  });
  declare_time_flags(flags, recipe);
  flags.group("Noise");
  declare_generator_flag(flags, recipe.noise, recipe.dims);
  flags.group("Layers");
  declare_layer_flags(flags, recipe);
  declare_plane(flags, options);
  flags.group("Run");
  declare_fields<RunOptions>(flags, options, {"threads", "max_memory", "max_time", "quiet"});
  return noise_flags;
}

void check_slice_options(const FlagSet& flags, SliceOptions& options,
                         const std::vector<std::string>& noise_flags) {
  check_outputs(options);
  if (options.spectrum.empty()) flags.refuse({"--spectrum-scale"}, "is of --spectrum, which is missing");
  check_line(flags, options);
  check_file(flags, options, noise_flags);
  if (options.file.empty()) check_recipe(options);
  options.line = options.is_line();
  if (options.line) options.plane.rows = 1;
  place_plane(options, options);
  if (!options.spectrum.empty()) {
    const int side = std::min(options.plane.columns, options.plane.rows);
    require_at_least("resolution", side, 2, "pixels along both axes, for --spectrum");
  }
}

}  // namespace solidnoise
