#include <array>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/flag_set.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "noisefit/commands.h"
#include "noisefit/fit_limits.h"
#include "noisefit/model_file.h"
#include "solidnoise/analysis/exemplar/describe_fit.h"
#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/analysis/exemplar/exemplar_sheet.h"
#include "solidnoise/analysis/exemplar/fit_exemplar.h"
#include "solidnoise/analysis/exemplar/solid_spectrum.h"

namespace solidnoise {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kDescription[] =
    "noisefit turns pictures of a texture into a procedural noise that looks like it: its power spectrum as\n"
    "a few hundred numbers, in a file that vdbnoise and meshnoise take as --noise.\n"
    "  noisefit IN.png ... --out OUT.json    learns from one or several exemplars\n"
    "  noisefit volume IN.vdb --out OUT.json learns from a box of a volume\n"
    "  noisefit info FILE.json               prints what is in such a file\n"
    "  noisefit edit FILE.json --out ...     changes groups of its components";

constexpr Choices<ColorAxes, 3> kColorAxesChoices{
    {{ColorAxes::independent, "independent"}, {ColorAxes::pca, "pca"}, {ColorAxes::rgb, "rgb"}}};

struct FitCommand {
  std::vector<std::string> inputs;
  FitOutputs outputs;
  FitLimits limits;
  ExemplarReading reading;
  ExemplarFitOptions fit;
  int seed = 1;
  bool grey = false;
  bool solid = false;
  bool quiet = false;
};

void declare_flags(FlagSet& flags, FitCommand& command) {
  flags.arguments("IN", "Pictures of the texture: .png, .jpg, .tif, .exr or .hdr; more are averaged",
                  command.inputs);
  flags.group("Flags");
  keep(flags, "--out", "FILE.json", "Where the noise goes; - for the standard output", command.outputs.model);
  keep(flags, "--preview", "FILE.png",
       "A sheet: the exemplar, its Gaussian version, the sparse spectrum, the noise",
       command.outputs.preview);
  flags.integer("--seed", "NUMBER", "Of the textures in the sheet (default 1)",
                [&](int value) { command.seed = value; });
  flags.toggle("--force", "Replace files that exist", [&] { command.outputs.existing = Existing::replace; });
  declare_limits(flags, command.limits);
  flags.toggle("--quiet", "Print errors only", [&] { command.quiet = true; });
  flags.group("The exemplar");
  flags.number("--pixel-size", "UNITS", "World units of a pixel (default 1)",
               [&](double value) { command.reading.pixel_size = value; });
  flags.toggle("--raw-values", "Take values as they are stored; otherwise they become linear light",
               [&] { command.reading.raw_values = true; });
  flags.toggle("--grey", "Learn the brightness alone", [&] { command.grey = true; });
  flags.integer("--patch", "PIXELS", "Average over patches of this size (default: the smallest exemplar)",
                [&](int value) { command.fit.patch = value; });
  declare_choice(flags, "--axes", kColorAxesChoices, "The channels of a coloured noise (default independent)",
                 command.fit.axes);
  flags.group("The spectrum");
  flags.toggle("--paper", "The paper's parameters: the narrowest band, one kappa for all channels", [&] {
    command.fit.spectrum = SpectrumFitOptions::of_paper();
    command.fit.weigh_channels = false;
  });
  flags.number("--kappa", "RATIO", "Fewer components against accuracy, up to 1 (default 1/256 = 0.0039)",
               [&](double value) { command.fit.spectrum.kappa = value; });
  flags.toggle("--narrowest-band", "Components as narrow as one frequency, for periodic textures",
               [&] { command.fit.spectrum.narrowest_band = true; });
  flags.toggle("--solid", "An isotropic noise in 3D whose slices look like the exemplar",
               [&] { command.solid = true; });
  flags.number("--gap", "RATIO", "Duality gap at which a solution is accepted (default 0.01)",
               [&](double value) { command.fit.spectrum.gap_tolerance = value; });
  flags.footer("A Ctrl-C ends the fit early and keeps the last solution.");
  flags.version(std::string(kNoisefit) + "\n");
}

// Brightness as an eye weighs the colours of linear light.
void make_grey(Exemplar<2>& exemplar) {
  if (exemplar.channels.size() == 1) return;
  constexpr std::array kWeights{0.2126f, 0.7152f, 0.0722f};
  DenseField<2> grey(exemplar.shape().count, exemplar.shape().step);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < grey.values.size(); ++i) {
      grey.values[i] += kWeights[c] * exemplar.channels[c].values[i];
    }
  }
  exemplar.channels = {grey};
}

// One picture in colour makes all of them so.
void agree_on_channels(std::vector<Exemplar<2>>& exemplars) {
  bool color = false;
  for (const Exemplar<2>& exemplar : exemplars) color = color || exemplar.channels.size() == 3;
  if (!color) return;
  for (Exemplar<2>& exemplar : exemplars) exemplar.channels.resize(3, exemplar.channels.front());
}

double count_samples(const std::vector<Exemplar<2>>& exemplars) {
  double samples = 0.0;
  for (const Exemplar<2>& exemplar : exemplars) {
    for (const DenseField<2>& channel : exemplar.channels)
      samples += static_cast<double>(channel.values.size());
  }
  return samples;
}

void warn_of_structure(const std::vector<Exemplar<2>>& exemplars, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    Exemplar<2> grey = exemplars[i];
    make_grey(grey);
    for (const std::string& warning : test_gaussianity(grey.channels.front()).warnings) {
      std::cerr << fmt::format("noisefit: warning: {}: {}\n", names[i], warning);
    }
  }
}

FitCommand parse(const std::vector<std::string>& arguments) {
  FitCommand command;
  FlagSet flags("noisefit", kDescription);
  declare_flags(flags, command);
  flags.parse(arguments);
  try {
    flags.apply();
    command.fit.raw_values = command.reading.raw_values;
    command.fit.validate();
  } catch (const std::invalid_argument& error) {
    throw UsageError(flags.name_flag(error.what()));
  }
  if (!(command.reading.pixel_size > 0.0)) {
    throw UsageError(
        fmt::format("--pixel-size is {}; it must be greater than 0", command.reading.pixel_size));
  }
  if (command.fit.patch != 0 && command.fit.patch < 16) {
    throw UsageError(fmt::format("--patch is {}; it must be at least 16", command.fit.patch));
  }
  command.outputs.check(command.inputs);
  return command;
}

// Writes and draws a model; what it says in the sheet is `caption`.
void write_outputs(const FitCommand& command, const Exemplar<2>& exemplar, const ExemplarModel& model,
                   const std::string& caption) {
  command.outputs.write(model, [&] {
    const std::string name = std::filesystem::path(command.inputs.front()).stem().string();
    return draw_exemplar_sheet(
        exemplar, model,
        {.title = name, .caption = caption, .seed = static_cast<std::uint64_t>(command.seed)});
  });
}

int fit_solid(const FitCommand& command, const std::vector<Exemplar<2>>& exemplars) {
  SolidExemplarFit fit =
      fit_solid_exemplar(exemplars, command.fit.axes, command.fit.spectrum.kappa, command.fit.patch);
  fit.model.raw_values = command.reading.raw_values;
  write_outputs(command, exemplars.front(), fit.model, describe_shortly(fit));
  if (command.quiet) return kDone;
  std::cerr << describe(fit);
  for (const std::string& warning : fit.channels.front().warnings) {
    std::cerr << fmt::format("noisefit: warning: {}\n", warning);
  }
  return kDone;
}

int fit_planar(const FitCommand& command, const std::vector<Exemplar<2>>& exemplars) {
  const Clock::time_point start = Clock::now();
  ExemplarFit<2> fit;
  {
    TaskProgress progress(command.quiet ? ProgressBar::Visibility::hidden
                                        : ProgressBar::Visibility::if_terminal);
    progress.begin("fitting");
    fit = fit_exemplar<2>(exemplars, command.fit, &progress);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (fit.interrupted) return keep_last_solution(command.outputs, fit.model);
  write_outputs(command, exemplars.front(), fit.model, describe_shortly(fit, seconds));
  if (!command.quiet) std::cerr << describe(fit, seconds);
  return kDone;
}

}  // namespace

int run_fit(const std::vector<std::string>& arguments) {
  const FitCommand command = parse(arguments);
  std::vector<Exemplar<2>> exemplars;
  for (const std::string& input : command.inputs) {
    exemplars.push_back(read_exemplar(input, command.reading));
    if (command.grey) make_grey(exemplars.back());
  }
  agree_on_channels(exemplars);
  command.limits.check(count_samples(exemplars));
  if (!command.quiet) warn_of_structure(exemplars, command.inputs);

  catch_interrupts();
  return command.solid ? fit_solid(command, exemplars) : fit_planar(command, exemplars);
}

}  // namespace solidnoise
