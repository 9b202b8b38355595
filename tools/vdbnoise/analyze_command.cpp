#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_options.h"
#include "common/run_tool.h"
#include "solidnoise/analysis/four_panel.h"
#include "solidnoise/analysis/kernel_slice.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/analyze_volume.h"
#include "solidnoise/volume/vdb/vdb_read.h"
#include "vdbnoise/commands.h"

namespace solidnoise {
namespace {

constexpr char kAnalyzeDescription[] =
    "Measures a grid of an OpenVDB file and prints JSON: moments, histogram beside the Gaussian, radial "
    "power\n"
    "spectrum beside the closed form of the recipe that the file carries.";

// The slice through the middle of a block, across z.
DenseField<2> middle_slice(const DenseField<3>& block) {
  DenseField<2> slice({block.count.x, block.count.y}, {block.step.x, block.step.y});
  const auto depth = static_cast<std::size_t>(block.count.z);
  for (std::size_t i = 0; i < slice.values.size(); ++i) slice.values[i] = block.values[i * depth + depth / 2];
  return slice;
}

std::string title_of(const AnalysisSubject& subject, const std::string& file) {
  const std::string name = std::filesystem::path(file).filename().string();
  if (!subject.recipe) return name;
  const NoiseRecipe& recipe = subject.recipe->noise;
  const double frequency = std::visit([](const auto& options) { return options.frequency; }, recipe.noise);
  return fmt::format("{}: {} noise, {}D, frequency {}", name, noise_type(recipe), subject.recipe->dims,
                     frequency);
}

Image draw(const AnalysisSubject& subject, const AnalysisReport& report, const std::string& file) {
  FourPanelOptions options;
  options.title = title_of(subject, file);
  const DenseField<2> kernel =
      subject.recipe ? kernel_slice(subject.recipe->noise, subject.recipe->dims) : DenseField<2>();
  return draw_four_panels(
      middle_slice(*subject.block), kernel, options,
      report.comparison ? SpectrumPlot(*report.comparison) : SpectrumPlot(report.spectrum));
}

// Where the file has no such grid, reading it says so.
void require_cost(const RunOptions& options, const std::string& file, const std::string& name) {
  for (const GridSummary& grid : read_vdb_summary(file).grids) {
    if (grid.value_type != "float" || (!name.empty() && grid.name != name)) continue;
    const Cost cost = analysis_cost(grid);
    return options.require_cost(fmt::format("the analysis of {} voxels", grid.active_voxels), cost);
  }
}

}  // namespace

int run_analyze(const std::vector<std::string>& arguments) {
  std::string file;
  std::string grid_name;
  std::string plot;
  RunOptions options;
  FlagSet flags("vdbnoise analyze", kAnalyzeDescription);
  flags.argument("FILE", "The .vdb or .nvdb", file);
  flags.keep("--grid", "NAME", "The grid to measure (default: the first one of floats)", grid_name);
  flags.keep("--plot", "FILE.png",
             "A picture: noise, kernel, the Fourier transform of each, and the spectrum", plot);
  declare_fields(flags, options, {"force", "max_memory", "max_time"});
  flags.parse(arguments);
  flags.apply();
  require_extension("--plot", plot, {".png"}, StandardOutput::refused);
  require_outputs({plot}, options.existing(), {file});

  require_cost(options, file, grid_name);
  const AnalysisSubject subject = analysis_subject(read_float_grid(file, grid_name), file);
  if (!plot.empty() && !subject.block) {
    throw std::runtime_error(file + ": no block of its voxels is dense enough for --plot");
  }
  const AnalysisReport report = analyze(subject);
  if (!plot.empty()) write_image(plot, draw(subject, report, file), {.existing = options.existing()});
  std::cout << format_json(report.json);
  return kDone;
}

}  // namespace solidnoise
