#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include "common/frames.h"
#include "common/outputs.h"
#include "common/parse_value.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "meshnoise/bake_options.h"
#include "meshnoise/commands.h"
#include "meshnoise/mesh_files.h"
#include "meshnoise/recipe_source.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {
namespace {

constexpr char kBakeDescription[] =
    "meshnoise bake puts procedural noise onto a surface, as vertex colours, without texture coordinates.\n"
    "  meshnoise bake in.ply --out out.ply                                  rust\n"
    "  meshnoise bake in.ply --out out.ply --frequency 4..32                ... finer where the surface "
    "bends out";

// What the flags leave without effect is refused rather than ignored.
void check_consistency(const FlagSet& flags, const BakeRecipe& recipe) {
  if (!recipe.steers()) {
    flags.refuse({"--by", "--percentiles", "--gamma"},
                 "has no effect where no parameter is a range; give --frequency A..B, say");
  }
  if (!has_direction(recipe.noise)) {
    flags.refuse({"--follow", "--direction", "--direction-smooth"},
                 "applies to --noise oriented and to flat exemplars only");
  }
  if (recipe.refine.mode == RefineRecipe::Mode::off) {
    flags.refuse({"--refine-shape", "--refine-method"}, "has no effect without --refine");
  }
  if (recipe.refine.mode != RefineRecipe::Mode::automatic) {
    flags.refuse({"--refine-budget"}, "has no effect without --refine auto");
  }
  const std::string lacks =
      fmt::format("does not apply to --noise {}", name_of(kSurfaceNoiseChoices, recipe.noise.kind));
  if (!has_bandwidth(recipe.noise.kind)) flags.refuse({"--bandwidth"}, lacks);
  if (!is_gabor(recipe.noise.kind)) flags.refuse({"--impulses", "--error"}, lacks);
  if (!has_layer(recipe.noise)) {
    flags.refuse({"--layer"}, "applies to --noise surface, oriented and flat exemplars only");
  }
}

void check_sequence(const FlagSet& flags, const std::string& in, const BakeOptions& options) {
  if (options.has_rest() && options.recipe.refine.mode != RefineRecipe::Mode::off) {
    throw UsageError(
        "--rest is a mesh of the same vertices; leave --refine out, or refine both meshes before");
  }
  if (options.has_rest() && options.recipe.displace != 0.0) {
    throw UsageError("--rest does not go with --displace, which moves vertices from where they are at rest");
  }
  if (options.frames.empty()) {
    flags.refuse({"--fps"}, "has no effect without --frames");
    refuse_frame_number("IN", in);
    refuse_frame_number("--out", options.out);
    return refuse_frame_number("--preview", options.preview);
  }
  if (!options.recipe.changes_with_time() && !has_frame_number(in)) {
    throw UsageError(
        "--frames has no effect on a noise that does not change; give --evolve, --dims 4 or a mesh of each "
        "frame "
        "(in.####.ply) too");
  }
  if (in == "-" || options.out == "-") throw UsageError("--frames needs files, such as out.####.ply");
}

// One frame of a sequence, and the mesh that it is made on.
BakeOptions options_of_frame(const BakeOptions& options, int frame, std::string& in) {
  BakeOptions result = options;
  if (has_frame_number(in)) in = frame_path("IN", in, frame);
  if (!result.out.empty()) result.out = frame_path("--out", options.out, frame);
  if (!result.preview.empty()) result.preview = frame_path("--preview", options.preview, frame);
  if (frame != options.frames.front()) result.write_recipe.clear();
  if (options.recipe.changes_with_time()) {
    result.recipe.noise.time += frame_time(frame, options.fps, options.recipe.noise.loop);
  }
  return result;
}

void check_outputs(const FlagSet& flags, const std::string& in, const BakeOptions& options) {
  if (options.out.empty() && options.preview.empty() && options.write_recipe.empty()) {
    throw UsageError("--out is missing; say where the mesh goes: --out out.ply");
  }
  if (options.out == "-" && options.write_recipe == "-") {
    throw UsageError("--out and --write-recipe cannot both be the standard output");
  }
  const bool displaces = options.recipe.displace != 0.0;
  if (!options.out.empty()) require_mesh_name(options.out, displaces ? Shows::shape : Shows::colors);
  if (!options.keep.empty() && !holds_numbers(options.out)) {
    throw UsageError(
        "--keep has no effect where --out is no .ply, .om, .glb or .usda, which alone hold such numbers");
  }
  if (!options.preview.empty()) require_preview(options.preview);
  if (options.preview.empty()) {
    flags.refuse({"--preview-size", "--preview-turn", "--preview-elevation"},
                 "has no effect without --preview");
  }
  require_extension("--write-recipe", options.write_recipe, {".json"}, StandardOutput::allowed);
  const std::string recipe = flags.value_of("--recipe").value_or("");
  const std::string noise = flags.value_of("--noise").value_or("");
  if (options.usd) require_usd(options.out);
  require_outputs({{options.out, in},
                   options.usd ? usd_path(options.out) : std::string(),
                   options.preview,
                   {options.write_recipe, recipe}},
                  options.existing(), {in, recipe, noise, options.rest});
}

// And what showing all of the noise would cost.
void warn_of_aliasing(const BakePlan& plan, RefineRecipe::Mode refine) {
  if (plan.mean_cycles_per_edge <= kHighestCyclesPerEdge) return;
  const std::string cost =
      std::isfinite(plan.vertices_to_show)
          ? fmt::format("takes about {:.2g} million vertices and {:.2g} GB", 1e-6 * plan.vertices_to_show,
                        1e-9 * bake_memory(plan.vertices_to_show, 2.0 * plan.vertices_to_show))
          : fmt::format("takes more than {:.0f} million vertices", 1e-6 * kMostCounted);
  const bool is_automatic = refine == RefineRecipe::Mode::automatic;
  std::cerr << fmt::format(
      "meshnoise: warning: the noise reaches {:.2f} cycles per edge, above 0.5, and will alias; to show all "
      "of "
      "it {}: {}, or make the features larger (--detail, --feature-size, --frequency), or --octaves fewer\n",
      plan.mean_cycles_per_edge, cost, is_automatic ? "raise --refine-budget" : "use --refine auto");
}

void print_plan(const BakePlan& plan, const std::string& steered_by, RefineRecipe::Mode refine) {
  constexpr std::size_t kBarWidth = 50;
  const SteeringWeights& steering = plan.guides.steering;
  if (!plan.guides.numbers.empty()) {
    std::cerr << fmt::format("{}: {:.4g} to {:.4g}, ranges from {:.4g} to {:.4g}\n", steered_by,
                             steering.least, steering.most, steering.low, steering.high);
    if (steering.low < steering.high) std::cerr << draw_histogram(steering, kBarWidth);
  }
  warn_of_aliasing(plan, refine);
}

// The mesh then goes through itself.
void warn_of_displacement(const BakedMesh& baked, const BakePlan& plan, double displace) {
  Vec<3> lower(std::numeric_limits<double>::infinity());
  Vec<3> upper = -lower;
  for (const Vec<3>& position : plan.mesh.positions) {
    lower = glm::min(lower, position);
    upper = glm::max(upper, position);
  }
  const double farthest =
      std::abs(displace) * std::max(std::abs(baked.moments.min()), std::abs(baked.moments.max()));
  const Vec<3> size = upper - lower;
  const double longest = std::max({size.x, size.y, size.z});
  if (!(farthest > 0.5 * longest)) return;
  std::cerr << fmt::format(
      "meshnoise: warning: --displace moves vertices by up to {:.4g}, through a mesh {:.4g} long; make it "
      "smaller\n",
      farthest, longest);
}

void write_baked(const BakedMesh& baked, const BakeOptions& options, std::vector<std::string> comments,
                 const std::string& source, Progress* progress, OutputGroup* group) {
  MeshWriteOptions write;
  for (std::string& comment : recipe_comments(options.recipe)) comments.push_back(std::move(comment));
  write.comments = std::move(comments);
  write.existing = options.existing();
  write.progress = progress;
  write.group = group;
  write.up = options.recipe.up;
  write_output_mesh(options.out, baked.mesh, write, source);
  if (options.usd) write_mesh(usd_path(options.out), baked.mesh, write);
}

// Those of an earlier bake are replaced by ours.
std::vector<std::string> foreign_comments(const std::vector<std::string>& comments) {
  std::vector<std::string> foreign;
  for (const std::string& comment : comments) {
    const bool ours = recipe_in_comments({comment}) || comment.starts_with("meshnoise ");
    if (!ours) foreign.push_back(comment);
  }
  return foreign;
}

std::string steering_name(const Steering& steering) {
  return steering.source == SteeringSource::attribute
             ? steering.attribute
             : std::string(name_of(kSteeringChoices, steering.source));
}

MeshReading read_mesh_to_bake(const std::string& in, const BakeOptions& options) {
  MeshReading reading =
      read_input_mesh(in, options.quiet ? Notes::keep_quiet : Notes::print, Faces::optional);
  const Steering& by = options.recipe.by;
  const bool by_attribute = options.recipe.steers() && by.source == SteeringSource::attribute;
  if (!by_attribute || reading.mesh.property(by.attribute)) return reading;
  std::vector<std::string> names;
  for (const VertexProperty& property : reading.mesh.properties) names.push_back(property.name);
  throw std::runtime_error(
      fmt::format("{}: --by is {}; its vertices have {}", in, by.attribute,
                  names.empty() ? "no numbers" : fmt::format("{}", fmt::join(names, ", "))));
}

// What points without faces have not.
void warn_of_points(const PolygonMesh& mesh, const std::string& in, const BakeOptions& options) {
  if (mesh.face_count() > 0 || options.quiet) return;
  std::cerr << fmt::format("meshnoise: {}: {} points without faces: no curvature to follow{}\n", in,
                           mesh.positions.size(),
                           options.preview.empty() ? "" : ", and nothing in the preview");
}

// Those that numbers of the vertices say: NAME_x, NAME_y and NAME_z, or NAMEx, NAMEy and NAMEz.
std::vector<Vec<3>> rest_positions(const PolygonMesh& mesh, const std::string& in, const std::string& name) {
  std::vector<Vec<3>> positions(mesh.positions.size());
  for (int axis = 0; axis < 3; ++axis) {
    const std::string plain = name + "xyz"[axis];
    const VertexProperty* property = mesh.property(name + '_' + "xyz"[axis]);
    if (!property) property = mesh.property(plain);
    if (!property) {
      throw std::runtime_error(
          fmt::format("{}: --rest-property is {}; its vertices have no number {}_{} or {}", in, name, name,
                      "xyz"[axis], plain));
    }
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v][axis] = property->values[v];
  }
  return positions;
}

// Gives a mesh the positions that its vertices have at rest; returns it as it was.
PolygonMesh put_to_rest(PolygonMesh& mesh, const std::string& in, const BakeOptions& options) {
  PolygonMesh deformed = mesh;
  if (!options.rest_property.empty()) {
    mesh.positions = rest_positions(mesh, in, options.rest_property);
    return deformed;
  }
  const PolygonMesh rest = read_input_mesh(options.rest, Notes::keep_quiet, Faces::optional).mesh;
  if (rest.positions.size() != mesh.positions.size()) {
    throw std::runtime_error(fmt::format("{}: --rest has {} vertices; {} has {}", options.rest,
                                         rest.positions.size(), in, mesh.positions.size()));
  }
  mesh.positions = rest.positions;
  return deformed;
}

void write_recipe(const BakeOptions& options, OutputGroup* group) {
  if (options.write_recipe.empty()) return;
  write_text_file(options.write_recipe, format_json(to_json(options.recipe)),
                  {.existing = options.existing(), .group = group});
}

// Within --max-memory.
BakePlan plan_within_memory(PolygonMesh mesh, const BakeOptions& options) {
  const std::uint64_t limit = options.memory_limit();
  if (limit == 0) return plan_bake(std::move(mesh), options.recipe);
  const double share = options.preview.empty() ? 1.0 : kPreviewMemory;
  try {
    return plan_bake(std::move(mesh), options.recipe,
                     static_cast<std::uint64_t>(static_cast<double>(limit) / share));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}; {}", error.what(), options.say_memory_limit()));
  }
}

// And within --max-time.
BakePlan plan_within(PolygonMesh mesh, const BakeOptions& options) {
  BakePlan plan = plan_within_memory(std::move(mesh), options);
  const double seconds =
      bake_cost(plan, options.recipe).seconds / static_cast<double>(tbb::this_task_arena::max_concurrency());
  options.require_cost(fmt::format("{} vertices", plan.mesh.positions.size()), {0.0, seconds});
  return plan;
}

void bake_file(const std::string& in, const BakeOptions& options) {
  catch_interrupts();
  options.times->begin("reading");
  MeshReading reading = read_mesh_to_bake(in, options);
  if (options.out.empty() && options.preview.empty()) return write_recipe(options, nullptr);
  const bool keeps = keeps_the_rest(in, options.out) && has_rest(reading) &&
                     options.recipe.refine.mode == RefineRecipe::Mode::off;
  if (!keeps && !options.quiet) print_dropped(in, reading);
  warn_of_points(reading.mesh, in, options);
  std::optional<PolygonMesh> deformed;
  if (options.has_rest()) deformed = put_to_rest(reading.mesh, in, options);
  options.times->begin("plan");
  const BakePlan plan = plan_within(std::move(reading.mesh), options);
  if (!options.quiet) print_plan(plan, steering_name(options.recipe.by), options.recipe.refine.mode);

  TaskProgress progress(options.visibility());
  options.times->begin("noise");
  progress.begin("noise", [&] { options.times->begin("colors"); });
  BakedMesh baked = bake(plan, options.recipe, options.keep, &progress);
  if (deformed) {
    baked.mesh.positions = std::move(deformed->positions);
    const SurfaceMesh surface(baked.mesh);
    baked.normals = surface.to_vertices(surface.normals());
  }
  options.times->begin("writing");
  progress.begin("writing");
  std::optional<Image> preview;
  if (!options.preview.empty()) {
    preview = render_mesh_preview(baked.mesh, baked.normals, baked.colors, options.recipe.up, options.view);
  }
  throw_if_cancelled(&progress);
  OutputGroup outputs;
  if (preview) write_image(options.preview, *preview, {.existing = options.existing(), .group = &outputs});
  write_recipe(options, &outputs);
  if (!options.out.empty()) {
    write_baked(baked, options, foreign_comments(reading.comments), keeps ? in : std::string(), &progress,
                &outputs);
  }
  outputs.appear();
  options.times->begin("end");
  if (options.quiet) return;
  warn_of_displacement(baked, plan, options.recipe.displace);
  std::cerr << fmt::format("{}: {} vertices, {} faces\nmin {:.6g}  max {:.6g}  mean {:.6g}  sigma {:.6g}\n",
                           options.out.empty() ? options.preview : options.out, baked.mesh.positions.size(),
                           baked.mesh.face_count(), baked.moments.min(), baked.moments.max(),
                           baked.moments.mean(), baked.moments.sigma());
}

}  // namespace

int run_bake(const std::vector<std::string>& arguments) {
  BakeOptions options;
  std::string in;
  FlagSet flags("meshnoise bake", kBakeDescription);
  flags.optional_argument("IN", "The mesh: .ply, .obj, .off, .stl or .om", in);
  declare_bake_flags(flags, options);
  flags.version(kMeshnoise);
  flags.parse(arguments);
  options.recipe = choose_bake_recipe(flags);
  try {
    flags.apply();
    if (in.empty()) throw UsageError("IN is missing; say which mesh: meshnoise bake in.ply --out out.ply");
    check_consistency(flags, options.recipe);
    check_sequence(flags, in, options);
    options.recipe.validate();
    require_keepable(options.keep, options.recipe);
    const auto threads = options.limit_threads();
    if (flags.given("--describe")) {
      const BakeOptions one =
          options.frames.empty() ? options : options_of_frame(options, options.frames.front(), in);
      MeshReading reading = read_mesh_to_bake(in, one);
      if (one.has_rest()) put_to_rest(reading.mesh, in, one);
      std::cout << format_json(describe_bake(plan_within(std::move(reading.mesh), one), one.recipe));
    } else if (options.frames.empty()) {
      check_outputs(flags, in, options);
      bake_file(in, options);
    } else {
      const auto for_each_frame = [&](const auto& visit) {
        for (const int frame : options.frames) {
          std::string mesh = in;
          const BakeOptions of_frame = options_of_frame(options, frame, mesh);
          visit(mesh, of_frame);
        }
      };
      for_each_frame(
          [&](const std::string& mesh, const BakeOptions& one) { check_outputs(flags, mesh, one); });
      for_each_frame([](const std::string& mesh, const BakeOptions& one) { bake_file(mesh, one); });
    }
    if (options.timings) std::cerr << options.times->report();
  } catch (const std::invalid_argument& error) {
    throw UsageError(flags.name_flag(name_loop(flags, error.what())));
  }
  return kDone;
}

}  // namespace solidnoise
