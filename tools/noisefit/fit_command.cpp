#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "common/run_tool.h"
#include "noisefit/commands.h"
#include "noisefit/fit_flags.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/exemplar_patches.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/prepare_exemplars.h"
#include "solidnoise/analysis/exemplar/solid_spectrum.h"
#include "solidnoise/analysis/exemplar/square_colors.h"
#include "solidnoise/core/named_error.h"

namespace solidnoise {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kFitDescription[] =
    "noisefit turns pictures of a texture into a procedural noise that looks like it: its power spectrum as\n"
    "a few hundred numbers, in a file that vdbnoise and meshnoise take as --noise.\n"
    "  noisefit IN.png ... --out OUT.json    learns from one or several exemplars\n"
    "  noisefit volume IN.vdb --out OUT.json learns from a box of a volume\n"
    "  noisefit info FILE.json               prints what is in such a file\n"
    "  noisefit edit FILE.json --out ...     changes groups of its components";

struct FitCommand : FitOptions {
  std::vector<std::string> inputs;
  ExemplarReading reading;
  bool chooses_values = true;  // between those that are stored, linear light and squares
  bool grey = false;
  bool solid = false;
};

void declare_flags(FlagSet& flags, FitCommand& command) {
  flags.arguments("IN", "Pictures of the texture: .png, .jpg, .tif, .exr or .hdr; more are averaged",
                  command.inputs);
  declare_output_flags(flags, command,
                       "A sheet: the exemplar, its Gaussian version, the sparse spectrum, the noise");
  flags.group("The exemplar");
  declare_fields(flags, command.reading, {"pixel_size"});
  const auto take = [&](bool raw) {
    command.chooses_values = false;
    command.reading.raw_values = raw;
  };
  flags.toggle(
      "--raw-values",
      "Take values as they are stored; without it, --linear-light and --squares, that of the three of which "
      "less is clipped, and which is less lopsided",
      [take] { take(true); });
  flags.toggle("--linear-light", "Take values as linear light", [take] { take(false); });
  flags.toggle("--grey", "Learn the brightness alone", [&] { command.grey = true; });
  declare_patch_flag(flags, command, "PIXELS");
  declare_fields(flags, command.fit);
  flags.exclude({"--raw-values", "--linear-light", "--squares"});
  flags.group("The spectrum");
  flags.toggle("--paper", "The paper's parameters: the narrowest band, one kappa for all channels", [&] {
    command.fit.spectrum = SpectrumFitOptions::of_paper();
    command.fit.weigh_channels = false;
  });
  declare_fields(flags, command.fit.spectrum);
  flags.toggle("--solid", "An isotropic noise in 3D whose slices look like the exemplar",
               [&] { command.solid = true; });
  flags.version(kNoisefit);
}

// Pixels along each side of what is tested for structure, in the middle of a picture: enough for any texture.
constexpr int kLargestTested = 1024;

// The pictures, each refused before it takes more memory than is allowed, with those that are held.
std::vector<Exemplar<2>> read_exemplars(const FitCommand& command) {
  std::vector<Exemplar<2>> exemplars;
  double held = kPictureProgramBytes;
  for (const std::string& input : command.inputs) {
    exemplars.push_back(read_exemplar(input, command.reading, nullptr, [&](std::uint64_t pixels) {
      command.require_cost("reading it", {.bytes = held + 2.0 * static_cast<double>(pixels)});
    }));
    const Exemplar<2>& exemplar = exemplars.back();
    held += static_cast<double>(sizeof(float) * exemplar.channels.size() * exemplar.shape().size());
  }
  return exemplars;
}

void require_fit_cost(const FitCommand& command, const std::vector<Exemplar<2>>& exemplars) {
  // In colour, of a picture, the exemplar that is made of it, and its square roots.
  const double bytes_per_pixel = command.fit.squares ? 36.0 : 24.0;
  FitSize size = fit_size(exemplars, command);
  size.held = kPictureProgramBytes;
  for (const Exemplar<2>& exemplar : exemplars) {
    size.held += bytes_per_pixel * static_cast<double>(exemplar.shape().size());
    const glm::ivec2 tested = glm::min(exemplar.shape().count, kLargestTested);
    if (!command.quiet) size.tested = std::max(size.tested, static_cast<double>(tested.x) * tested.y);
  }
  require_fit_cost(command, size);
}

std::string describe_choice(const ValueChoice& choice) {
  return fmt::format(
      "values: {} ({:.2g} % of the noise is clipped, skewness {:.2g}); --raw-values, --linear-light and "
      "--squares choose\n",
      choice.squares      ? "squares"
      : choice.raw_values ? "as they are stored"
                          : "linear light",
      100.0 * choice.fit.clipped, choice.fit.skewness);
}

// Of what noise is learnt from: values, or their square roots.
void warn_of_structure(const std::vector<Exemplar<2>>& exemplars, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    const glm::ivec2 count = glm::min(exemplars[i].shape().count, kLargestTested);
    Exemplar<2> grey;
    for (const DenseField<2>& channel : exemplars[i].channels)
      grey.channels.push_back(cut_patch(channel, (channel.count - count) / 2, count));
    make_grey(grey);
    for (const std::string& warning : test_gaussianity(grey.channels.front()).warnings) {
      std::cerr << fmt::format("noisefit: warning: {}: {}\n", names[i], warning);
    }
  }
}

// Writes and draws a model; what it says in the sheet is `caption`.
void write_outputs(const FitCommand& command, const Exemplar<2>& exemplar, const ExemplarModel& model,
                   const std::string& caption) {
  command.outputs.write(model, [&] {
    const std::string name = std::filesystem::path(command.inputs.front()).stem().string();
    return draw_exemplar_sheet(exemplar, model, {.title = name, .caption = caption, .seed = command.seed});
  });
}

int fit_solid(const FitCommand& command, const std::vector<Exemplar<2>>& exemplars) {
  const SolidExemplarFit fit = fit_solid_exemplar(exemplars, command.fit);
  write_outputs(command, exemplars.front(), fit.model, describe_shortly(fit));
  if (command.quiet) return kDone;
  std::cerr << describe(fit) << describe_scale({fit.model, command.outputs.pixel_size});
  print_warnings(fit.channels.front().warnings);
  return kDone;
}

int fit_planar(const FitCommand& command, const std::vector<Exemplar<2>>& exemplars) {
  const Clock::time_point start = Clock::now();
  ExemplarFit<2> fit;
  {
    TaskProgress progress(command.visibility());
    progress.begin("fitting");
    fit = in_file(command.inputs.front(), [&] { return fit_exemplar<2>(exemplars, command.fit, &progress); });
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (fit.interrupted) return keep_last_solution(command.outputs, fit.model);
  write_outputs(command, exemplars.front(), fit.model, describe_shortly(fit, seconds));
  if (!command.quiet) {
    std::cerr << describe(fit, seconds) << describe_scale({fit.model, command.outputs.pixel_size});
    print_warnings(warnings_of(fit.channels, command.fit.spectrum.gap_tolerance));
  }
  return kDone;
}

}  // namespace

int run_fit(const std::vector<std::string>& arguments) {
  FitCommand command;
  FlagSet flags("noisefit", kFitDescription);
  declare_flags(flags, command);
  parse_fit(flags, arguments, command);
  if (flags.given("--pixel-size")) command.outputs.pixel_size = command.reading.pixel_size;
  command.outputs.check(command.inputs);
  if (command.fit.squares) command.chooses_values = false;
  command.reading.raw_values = command.reading.raw_values || command.fit.squares || command.chooses_values;
  std::vector<Exemplar<2>> exemplars = read_exemplars(command);
  std::string choice;
  if (command.chooses_values) {
    std::vector<bool> linear;
    for (const std::string& input : command.inputs) linear.push_back(holds_linear_light(input));
    const ValueChoice values = choose_values(exemplars, linear);
    command.reading.raw_values = values.raw_values;
    command.fit.squares = values.squares;
    choice = describe_choice(values);
  }
  command.fit.raw_values = command.reading.raw_values;
  for (Exemplar<2>& exemplar : exemplars) {
    if (command.grey) make_grey(exemplar);
  }
  agree_on_channels(exemplars);
  require_fit_cost(command, exemplars);
  if (!command.quiet) {
    std::cerr << choice;
    if (command.fit.squares && !are_squares(exemplars)) {
      std::cerr
          << "noisefit: warning: --squares: values are below 0, or more lopsided than squares of noise, "
             "which vary less\n";
    }
    warn_of_structure(command.fit.squares ? square_roots(std::span<const Exemplar<2>>(exemplars)) : exemplars,
                      command.inputs);
  }

  catch_interrupts();
  return command.solid ? fit_solid(command, exemplars) : fit_planar(command, exemplars);
}

}  // namespace solidnoise
