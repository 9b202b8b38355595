#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_options.h"
#include "common/run_tool.h"
#include "meshnoise/commands.h"
#include "meshnoise/mesh_files.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_fields.h"
#include "solidnoise/mesh/vertex_colors.h"

namespace solidnoise {
namespace {

constexpr char kCurvatureDescription[] =
    "meshnoise curvature shows the curvature of a surface as vertex colours, and puts it into a .ply as "
    "numbers:\n"
    "mean_curvature, gaussian_curvature, k1, k2 (1 / world unit; positive where the surface bulges out).";

// Measured: a vertex takes the four curvatures more than a bake does, and 4 microseconds; a picture half a
// second.
void require_cost(const RunOptions& options, const PolygonMesh& mesh, int picture_side) {
  const auto vertices = static_cast<double>(mesh.positions.size());
  const double bytes =
      bake_memory(vertices, static_cast<double>(mesh.face_count())) + 4.0 * sizeof(double) * vertices;
  Cost cost{4e-6 * vertices, bytes};
  if (picture_side > 0) cost = with_preview(cost, picture_side);
  options.require_cost(fmt::format("{} vertices", mesh.positions.size()), cost);
}

}  // namespace

int run_curvature(const std::vector<std::string>& arguments) {
  std::string in;
  std::string out;
  std::string preview;
  MeshView view;
  CurvatureRecipe recipe;
  RunOptions options;
  FlagSet flags("meshnoise curvature", kCurvatureDescription);
  flags.argument("IN", "The mesh: .ply, .obj, .off, .stl or .om, - for a .ply on the standard input", in);
  flags.keep("--out", "FILE",
             "Where the mesh goes: .ply, .obj, .off or .om, for scenes .glb or .usda; - for a .ply on the "
             "standard output",
             out);
  flags.keep("--preview", "FILE.png", "A picture of the mesh in its colours, rendered by Embree", preview);
  declare_fields(flags, view);
  declare_field(flags, recipe.by, "source", {"--by"},
                [&](SteeringSource source) { recipe.by.source = source; });
  declare_fields(flags, recipe.by, {"percentiles"});
  declare_fields(flags, recipe);
  declare_fields(flags, options, {"force", "max_memory", "max_time", "quiet"});
  flags.parse(arguments);
  flags.explained([&] {
    flags.apply();
    recipe.validate();
  });
  if (out.empty() && preview.empty())
    throw UsageError("--out is missing; say where the mesh goes: --out c.ply");
  if (!out.empty()) require_mesh_name(out, Shows::colors);
  if (!preview.empty()) require_preview(preview);
  require_outputs({{out, {in}}, preview}, options.existing(), {in});

  catch_interrupts();
  const MeshReading reading = read_input_mesh(in, options.quiet ? Notes::keep_quiet : Notes::print);
  require_cost(options, reading.mesh, preview.empty() ? 0 : view.size);
  const bool keeps = keeps_the_rest(in, out) && has_rest(reading);
  if (!keeps && !options.quiet) print_dropped(in, reading);
  TaskProgress progress(TaskProgress::Visibility::hidden);
  const ShownCurvature shown = show_curvature(reading.mesh, recipe);
  std::optional<Image> picture;
  if (!preview.empty())
    picture = render_mesh_preview(shown.mesh, shown.normals, shown.colors, recipe.up, view);
  throw_if_cancelled(&progress);
  OutputGroup outputs;
  if (picture) write_image(preview, *picture, {.existing = options.existing(), .group = &outputs});
  if (!out.empty()) {
    write_output_mesh(
        out, shown.mesh,
        {.comments = {kMeshnoise}, .existing = options.existing(), .progress = &progress, .group = &outputs},
        keeps ? in : std::string());
  }
  outputs.appear();
  if (!options.quiet) {
    std::cerr << fmt::format("{}: {} vertices, {:.4g} to {:.4g}, colours from {:.4g} to {:.4g}\n",
                             out.empty() ? preview : out, shown.mesh.positions.size(), shown.steering.least,
                             shown.steering.most, shown.steering.low, shown.steering.high);
  }
  return kDone;
}

}  // namespace solidnoise
