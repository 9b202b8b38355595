#include "meshnoise/bake_file.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include "common/noise_flags.h"
#include "common/outputs.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "meshnoise/commands.h"
#include "meshnoise/mesh_files.h"
#include "meshnoise/recipe_source.h"
#include "meshnoise/texture_output.h"
#include "solidnoise/core/bounds.h"
#include "solidnoise/core/format_bytes.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"
#include "solidnoise/mesh/surface_mesh.h"

namespace solidnoise {
namespace {

// To two digits: "3.4 million", "520".
std::string rounded_count(double count) {
  if (count >= 1e6) return fmt::format("{:.2g} million", 1e-6 * count);
  const double unit = std::pow(10.0, std::max(std::floor(std::log10(std::max(count, 1.0))) - 1.0, 0.0));
  return fmt::format("{:.0f}", unit * std::round(count / unit));
}

// And what showing all of the noise would cost.
void warn_of_aliasing(const BakePlan& plan, RefineRecipe::Mode refine) {
  if (plan.mean_cycles_per_edge <= kHighestCyclesPerEdge) return;
  const std::string cost =
      std::isfinite(plan.vertices_to_show)
          ? fmt::format("takes about {} vertices and {:.2g} GB", rounded_count(plan.vertices_to_show),
                        1e-9 * bake_memory(plan.vertices_to_show, 2.0 * plan.vertices_to_show))
          : fmt::format("takes more than {:.0f} million vertices", 1e-6 * kMostCounted);
  const bool is_automatic = refine == RefineRecipe::Mode::automatic;
  std::cerr << fmt::format(
      "meshnoise: warning: the noise reaches {:.2f} cycles per edge, above 0.5, and will alias; to show all "
      "of "
      "it {}: {}, or make the features larger (--detail, --feature-size, --frequency), or --octaves fewer\n",
      std::ceil(100.0 * plan.mean_cycles_per_edge) / 100.0, cost,
      is_automatic ? "raise --refine-budget" : "use --refine auto");
}

std::string steering_name(const Steering& steering) {
  return steering.source == SteeringSource::attribute
             ? steering.attribute
             : std::string(name_of(kSteeringChoices, steering.source));
}

// Curvatures that vary less than they are measured exactly, as a sphere's do.
bool hardly_varies(const SteeringWeights& steering, SteeringSource by) {
  constexpr double kExact = 0.01;
  const bool is_curvature = by != SteeringSource::height && by != SteeringSource::attribute;
  return is_curvature &&
         steering.high - steering.low < kExact * std::max(std::abs(steering.low), std::abs(steering.high));
}

void print_plan(const BakePlan& plan, const Steering& by, RefineRecipe::Mode refine) {
  constexpr std::size_t kBarWidth = 50;
  const std::string steered_by = steering_name(by);
  const SteeringWeights& steering = plan.guides.steering;
  if (!plan.guides.numbers.empty()) {
    std::cerr << fmt::format("{}: {:.4g} to {:.4g}, ranges from {:.4g} to {:.4g}\n", steered_by,
                             steering.least, steering.most, steering.low, steering.high);
    if (steering.low < steering.high) std::cerr << draw_histogram(steering, kBarWidth);
    if (hardly_varies(steering, by.source)) {
      std::cerr << fmt::format(
          "meshnoise: warning: {} hardly varies here; what follows it shows the errors of its measuring\n",
          steered_by);
    }
  }
  warn_of_aliasing(plan, refine);
}

// The mesh then goes through itself.
void warn_of_displacement(const BakedMesh& baked, const BakePlan& plan, const BakeRecipe& recipe) {
  const bool has_height = recipe.properties.contains(kHeightProperty);
  double farthest = 0.0;
  for (const double height : baked.mesh.property(has_height ? kHeightProperty : "noise")->values)
    farthest = std::max(farthest, std::abs(recipe.displace * height));
  const Box<3> box = bounds_of<3>(plan.mesh.positions);
  const Vec<3> size = box.upper - box.lower;
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
  if (has_plane(options.recipe.noise) && lies_in_unknown_planes(mesh)) {
    std::cerr << "meshnoise: warning: the points have no normals (nx, ny, nz), and this noise lies in planes "
                 "across the y axis; --noise solid needs no normals\n";
  }
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

// Of an .obj, whose lines stay but for the vertices'.
void warn_of_kept_normals(const std::string& in, const std::vector<std::string>& notes) {
  const auto is_of_normals = [](const std::string& note) { return note.starts_with("normals"); };
  if (std::ranges::none_of(notes, is_of_normals)) return;
  std::cerr << fmt::format(
      "meshnoise: warning: {}: the normals of its faces' corners stay, and are those of the shape before\n",
      in);
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

// Within --max-memory, until it is interrupted.
BakePlan plan_within_memory(PolygonMesh mesh, const BakeOptions& options) {
  TaskProgress progress(TaskProgress::Visibility::hidden);
  const std::uint64_t limit = options.memory_limit();
  if (limit == 0) return plan_bake(std::move(mesh), options.recipe, &progress);
  const auto most = static_cast<double>(limit);
  const double memory = options.preview.empty() ? most : std::max(most - kImageMemory, 0.0) / kPreviewMemory;
  try {
    return plan_bake(std::move(mesh), options.recipe, &progress, static_cast<std::uint64_t>(memory));
  } catch (const Cancelled&) {
    throw;
  } catch (const std::runtime_error& error) {
    const std::string of_preview = options.preview.empty()
                                       ? ""
                                       : fmt::format(", --preview takes {} of it",
                                                     format_bytes(static_cast<std::uint64_t>(most - memory)));
    throw std::runtime_error(fmt::format("{}; {}{}", error.what(), options.say_memory_limit(), of_preview));
  }
}

Cost cost_of(const BakePlan& plan, const BakeOptions& options) {
  const Cost bake = bake_cost(plan, options.recipe);
  return options.preview.empty() ? bake : with_preview(bake, options.view.size);
}

// And within --max-time.
BakePlan plan_within(PolygonMesh mesh, const BakeOptions& options) {
  BakePlan plan = plan_within_memory(std::move(mesh), options);
  const double seconds =
      cost_of(plan, options).seconds / static_cast<double>(tbb::this_task_arena::max_concurrency());
  options.require_cost(fmt::format("{} vertices", plan.mesh.positions.size()), {seconds, 0.0});
  return plan;
}

}  // namespace

BakePlan plan_frame(const BakeFrame& frame) {
  MeshReading reading = read_mesh_to_bake(frame.in, frame.options);
  if (frame.options.has_rest()) put_to_rest(reading.mesh, frame.in, frame.options);
  return plan_within(std::move(reading.mesh), frame.options);
}

Json describe_frame(const BakeFrame& frame) {
  const BakeOptions& options = frame.options;
  MeshReading reading = read_mesh_to_bake(frame.in, options);
  if (options.has_rest()) put_to_rest(reading.mesh, frame.in, options);
  std::optional<TextureJob> textures;
  if (!options.uv.empty()) {
    check_textures(options);
    textures = plan_texture_job(frame.in, reading, options);
  }
  const BakePlan plan = plan_within(std::move(reading.mesh), options);
  Json json = describe_bake(plan, options.recipe);
  const Cost cost = cost_of(plan, options);
  json["cost"] = {{"seconds_of_one_core", cost.seconds}, {"memory_bytes", cost.bytes}};
  if (textures) json["textures"] = describe_textures(*textures, options);
  return json;
}

void bake_frame(const BakeFrame& frame) {
  const auto& [in, options, is_first] = frame;
  catch_interrupts();
  options.times->begin("reading");
  MeshReading reading = read_mesh_to_bake(in, options);
  std::optional<PolygonMesh> deformed;
  if (options.has_rest()) deformed = put_to_rest(reading.mesh, in, options);
  std::optional<TextureJob> textures;
  if (!options.uv.empty()) textures = plan_texture_job(in, reading, options);
  if (options.out.empty() && options.preview.empty()) {
    TaskProgress progress(options.visibility());
    OutputGroup outputs;
    write_recipe(options, &outputs);
    if (textures) {
      options.times->begin("textures");
      progress.begin("textures");
      write_textures(*textures, options, &progress, &outputs);
    }
    return outputs.appear();
  }
  const bool is_ply = is_mesh_path(in) && mesh_format(in) == MeshFormat::ply;  // whose encoding stays, too
  const bool keeps = keeps_the_rest(in, options.out) && (is_ply || has_rest(reading)) &&
                     options.recipe.refine.mode == RefineRecipe::Mode::off &&
                     (options.recipe.displace == 0.0 || !has_scene(in));
  if (keeps) require_files_beside(in, options.out, reading);
  if (!keeps && !options.quiet) print_dropped(in, reading);
  if (!options.quiet) print_dropped_numbers(in, reading.mesh, options.out);
  if (keeps && !options.quiet && options.recipe.displace != 0.0) warn_of_kept_normals(in, reading.notes);
  warn_of_points(reading.mesh, in, options);
  if (is_first && !options.quiet) {
    const std::string warning = loop_warning(options.recipe.noise.evolution());
    if (!warning.empty()) std::cerr << "meshnoise: warning: " << warning;
  }
  options.times->begin("plan");
  const BakePlan plan = plan_within(std::move(reading.mesh), options);
  if (!options.quiet && is_first) print_plan(plan, options.recipe.by, options.recipe.refine.mode);

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
  if (textures) {
    options.times->begin("textures");
    progress.begin("textures");
    write_textures(*textures, options, &progress, &outputs);
  }
  if (preview) write_image(options.preview, *preview, {.existing = options.existing(), .group = &outputs});
  write_recipe(options, &outputs);
  if (!options.out.empty()) {
    write_baked(baked, options, foreign_comments(reading.comments), keeps ? in : std::string(), &progress,
                &outputs);
  }
  outputs.appear();
  options.times->begin("end");
  if (options.quiet) return;
  warn_of_displacement(baked, plan, options.recipe);
  std::cerr << fmt::format("{}: {} vertices, {} faces\nmin {:.6g}  max {:.6g}  mean {:.6g}  sigma {:.6g}\n",
                           options.out.empty() ? options.preview : options.out, baked.mesh.positions.size(),
                           baked.mesh.face_count(), baked.moments.min(), baked.moments.max(),
                           baked.moments.mean(), baked.moments.sigma());
}

}  // namespace solidnoise
