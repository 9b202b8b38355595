#include "vdbnoise/slice_options.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/field_flags.h"
#include "common/flag_set.h"
#include "common/run_tool.h"
#include "solidnoise/core/check.h"
#include "solidnoise/image/color.h"
#include "vdbnoise/recipe_flags.h"

namespace solidnoise {
namespace {

constexpr int kMostPixels = 16384;  // along a side
constexpr double kWidth = 2.0;      // world units, unless it is given or the period

bool is_picture(const std::string& path) {
  return path.ends_with(".png") || path.ends_with(".exr");
}

Vec<3> to_vec3(const std::vector<double>& numbers, std::size_t first = 0) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

void declare_output(FlagSet& flags, SliceOptions& options) {
  flags.group("Output");
  keep(flags, "--out", "FILE",
       ".png: 8 bits, or 16 with --bits; .exr: the values themselves, as floats; .csv: a line of samples",
       options.out);
  flags.choice("--bits", {"8", "16"}, "Of each channel of a .png (default 8)", [&](std::size_t index) {
    options.sample_type = index == 0 ? SampleType::uint8 : SampleType::uint16;
  });
  flags.numbers(
      "--values", "LOW HIGH", 2,
      "The values that are black and white, or the ends of the ramp (default: 3 sigmas of the noise "
      "to each side; of a grid, the least and the greatest of the slice)",
      [&](const std::vector<double>& v) {
        if (v[0] >= v[1]) {
          throw UsageError(fmt::format("--values is {} {}; the first must be below the second", v[0], v[1]));
        }
        options.values.emplace(v[0], v[1]);
      });
  flags.text("--ramp", "RAMP",
             fmt::format("Colours: {}, or stops such as 0:#000,1:#fff (default: grey, the pixel's number "
                         "proportional to the value)",
                         fmt::join(ramp_names(), ", ")),
             [&](const std::string& text) {
               parse_color_ramp(text);
               options.ramp = text;
             });
  flags.toggle(
      "--color",
      "Of a noise by example in colour its colours; of others three independent noises, one for each of "
      "red, green and blue",
      [&] { options.color = true; });
  flags.exclude({"--color", "--ramp"});
  flags.exclude({"--color", "--spectrum"});
  keep(flags, "--spectrum", "FILE",
       "The slice's periodogram, frequency 0 in the middle, half a cycle per pixel at the edges: .png, or "
       ".exr for the densities themselves",
       options.spectrum);
  flags.choice("--spectrum-scale", {"log", "linear"},
               "Of a .png: 60 dB below the greatest density to it, or 0 to it (default log)",
               [&](std::size_t index) {
                 options.spectrum_scale = index == 0 ? SliceOptions::SpectrumScale::logarithmic
                                                     : SliceOptions::SpectrumScale::linear;
               });
  flags.toggle("--force", "Replace files that exist", [&] { options.existing = Existing::replace; });
}

void declare_source(FlagSet& flags, SliceOptions& options) {
  flags.group("What is sliced");
  keep(flags, "--grid", "NAME", "The grid of FILE.vdb (default: the first one of floats)", options.grid);
  flags.text("--preset", "NAME", "Start from a recipe that comes with the program (default raw)",
             [](const std::string&) {});
  flags.text("--recipe", "FILE", "Start from a recipe, .json, or from that of a .vdb made by vdbnoise",
             [](const std::string&) {});
  flags.exclude({"--preset", "--recipe"});
  flags.toggle("--raw", "The recipe's noise itself, without its shaping",
               [&] { options.recipe.shaping = RawShaping{}; });
}

void declare_plane(FlagSet& flags, SliceOptions& options) {
  flags.group("Plane");
  flags.numbers("--origin", "X [Y Z]", 1,
                "The middle of the picture, world units (default 0 0 0, or the middle of the grid)",
                [&](const std::vector<double>& v) {
                  options.origin.emplace(0.0);
                  for (std::size_t axis = 0; axis < v.size(); ++axis) {
                    (*options.origin)[static_cast<int>(axis)] = v[axis];
                  }
                });
  flags.numbers("--normal", "X Y Z", 3, "Across the plane, towards the viewer (default 0 0 1)",
                [&](const std::vector<double>& v) { options.normal = to_vec3(v); });
  flags.numbers("--up", "X Y Z", 3, "What is up in the picture, as far as the plane allows (default 0 1 0)",
                [&](const std::vector<double>& v) { options.up = to_vec3(v); });
  flags.numbers("--axes", "X Y Z X Y Z", 6, "Instead of both: what is right and what is up",
                [&](const std::vector<double>& v) { options.plane.span(to_vec3(v), to_vec3(v, 3)); });
  flags.exclude({"--axes", "--normal"});
  flags.exclude({"--axes", "--up"});
  flags.number("--width", "UNITS",
               "Of the picture, world units (default 2, the period, or what holds the grid)",
               [&](double width) {
                 require_positive("width", width, "world units");
                 options.width = width;
               });
  flags.numbers("--resolution", "COLUMNS [ROWS]", 1,
                "In pixels, which are square (default 512, as many rows)", [&](const std::vector<double>& v) {
                  for (const double side : v) {
                    require_in_range("resolution", side, 1, kMostPixels, "pixels");
                    if (side != std::floor(side)) {
                      throw UsageError(fmt::format("--resolution is {}; it must be whole numbers", side));
                    }
                  }
                  options.plane.columns = static_cast<int>(v[0]);
                  options.plane.rows = static_cast<int>(v.back());
                });
}

// --normal and --up say one thing together.
void turn_plane(SliceOptions& options) {
  if (!options.normal && !options.up) return;
  const Vec<3> normal = options.normal.value_or(Vec<3>(0.0, 0.0, 1.0));
  const bool from_above = normal.x == 0.0 && normal.z == 0.0;
  options.plane.face(normal,
                     options.up.value_or(from_above ? Vec<3>(0.0, 0.0, -1.0) : Vec<3>(0.0, 1.0, 0.0)));
}

// The plane is one period wide unless it is told otherwise, where the noise has one along it.
void size_plane(SliceOptions& options) {
  SlicePlane& plane = options.plane;
  const double period = options.file.empty() ? period_along(plane.right, options.recipe.noise) : 0.0;
  const double width = options.width.value_or(period > 0.0 ? period : kWidth);
  plane.pixel = width / plane.columns;
  const double height = plane.pixel * plane.rows;
  options.wraps = period > 0.0 && width == period && height == period_along(plane.up, options.recipe.noise);
}

void check_outputs(const SliceOptions& options) {
  if (options.out.empty() && options.spectrum.empty()) {
    throw UsageError("--out is missing; say where the picture goes: --out noise.png");
  }
  if (!options.out.empty() && !options.is_line() && !is_picture(options.out)) {
    throw UsageError(fmt::format("--out is {}; it must end in .png, .exr or .csv", options.out));
  }
  if (!options.spectrum.empty() && !is_picture(options.spectrum)) {
    throw UsageError(fmt::format("--spectrum is {}; it must end in .png or .exr", options.spectrum));
  }
  if (options.sample_type != SampleType::automatic && !options.out.ends_with(".png")) {
    throw UsageError("--bits applies to --out FILE.png only");
  }
}

void check_line(const FlagSet& flags, const SliceOptions& options) {
  const bool of_one_dimension = options.file.empty() && options.recipe.dims == 1;
  if (of_one_dimension && !options.is_line()) {
    throw UsageError("--dims is 1; a noise on a line is written to --out FILE.csv");
  }
  if (!options.is_line()) return;
  for (const char* flag : {"--spectrum", "--ramp", "--values", "--color"}) {
    if (flags.given(flag)) throw UsageError(fmt::format("{} has no effect on a line", flag));
  }
  if (options.color) throw UsageError("the recipe makes colours, which a line has none of");
}

// What the noise of a recipe would be given for nothing where a grid is sliced.
void check_file(const FlagSet& flags, const SliceOptions& options) {
  if (options.file.empty()) {
    if (flags.given("--grid")) throw UsageError("--grid names a grid of FILE.vdb, which is missing");
    return;
  }
  for (const char* flag :
       {"--preset",    "--recipe",  "--raw",    "--noise",     "--seed",       "--frequency", "--size",
        "--bandwidth", "--octaves", "--period", "--offset",    "--band-limit", "--evolve",    "--dims",
        "--time",      "--loop",    "--fold",   "--histogram", "--warp",       "--color"}) {
    if (flags.given(flag)) {
      throw UsageError(fmt::format("{} has no effect where {} is sliced", flag, options.file));
    }
  }
}

void check_recipe(const SliceOptions& options) {
  const VolumeRecipe& recipe = options.recipe;
  if (!recipe.grids.empty() || !recipe.fields.empty()) {
    throw UsageError("the recipe makes several grids, or has named fields; slice the volume that it makes");
  }
  if (!std::holds_alternative<RawShaping>(recipe.shaping)) {
    throw UsageError(
        "the recipe shapes its noise; give --raw too to see the noise itself, or slice the volume that it "
        "makes");
  }
  if (options.color && !options.ramp.empty()) throw UsageError("--ramp has no effect on colours");
  if (options.color && !recipe.layers.empty()) throw UsageError("--color has no effect on layers");
  if (options.values && options.color && exemplar_of_colors(recipe)) {
    throw UsageError("--values has no effect on the colours of an exemplar");
  }
  if (!is_scalar(recipe) || recipe.modification || recipe.parameters.any()) {
    throw UsageError("the recipe is of more than a noise; slice the volume that it makes");
  }
  require_in_range("dims", recipe.dims, 1, 4);
  VolumeRecipe checked = recipe;
  if (recipe.dims < 3) {
    if (!recipe.layers.empty()) throw UsageError("--dims must be 3 or 4 where there are layers");
    checked.dims = 3;
  }
  checked.validate();
}

}  // namespace

void declare_slice_flags(FlagSet& flags, SliceOptions& options) {
  flags.optional_argument("FILE.vdb", "A volume whose grid is sliced, instead of a noise", options.file);
  declare_output(flags, options);
  declare_source(flags, options);
  flags.group("Noise");
  declare_noise_flags(flags, options.recipe.noise);
  flags.numbers("--offset", "X Y Z", 3, "Moves the noise, world units (default 0 0 0)",
                [&](const std::vector<double>& v) { options.recipe.offset = to_vec3(v); });
  flags.toggle("--band-limit", "Gabor noises: filter out what the pixels cannot hold, exactly",
               [&] { options.recipe.band_limit = true; });
  flags.toggle(
      "--exact",
      "Sum impulses at every pixel; without it, waves that pixels resolve well are interpolated from "
      "fewer samples, within --error",
      [&] { options.recipe.exact = true; });
  declare_time_flags(flags, options.recipe, "1|2|3|4");
  flags.group("Noise");
  declare_generator_flag(flags, options.recipe.noise, options.recipe.dims);
  flags.group("Layers");
  declare_layer_flags(flags, options.recipe);
  declare_plane(flags, options);
  flags.group("Run");
  flags.integer("--threads", "COUNT", "Threads to use (default: all)", [&](int value) {
    require_in_range("threads", value, 1, 4096);
    options.threads = value;
  });
  flags.toggle("--quiet", "Print errors only", [&] { options.quiet = true; });
}

void check_slice_options(const FlagSet& flags, SliceOptions& options) {
  check_outputs(options);
  check_line(flags, options);
  check_file(flags, options);
  if (options.file.empty()) check_recipe(options);
  turn_plane(options);
  options.line = options.is_line();
  if (options.line) options.plane.rows = 1;
  if (!options.spectrum.empty()) {
    const int side = std::min(options.plane.columns, options.plane.rows);
    require_at_least("resolution", side, 2, "pixels along both axes, for --spectrum");
  }
  if (options.origin) options.plane.origin = *options.origin;
  size_plane(options);
}

void fit_plane(SliceOptions& options, const Box<3>& bounds) {
  SlicePlane& plane = options.plane;
  if (!options.origin) plane.origin = 0.5 * (bounds.lower + bounds.upper);
  if (options.width) return;
  const Vec<3> size = bounds.upper - bounds.lower;
  plane.pixel = std::max(glm::dot(size, glm::abs(plane.right)) / plane.columns,
                         glm::dot(size, glm::abs(plane.up)) / plane.rows);
}

}  // namespace solidnoise
