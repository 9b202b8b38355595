#include <iostream>

#include <fmt/format.h>

#include "common/flag_set.h"
#include "common/run_tool.h"
#include "meshnoise/commands.h"
#include "meshnoise/recipe_source.h"
#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/geometry/read_points.h"

namespace solidnoise {
namespace {

void print_count(const char* what, std::size_t count) {
  if (count > 0) std::cout << fmt::format("  {} {}\n", count, what);
}

void print_properties(const PolygonMesh& mesh) {
  if (mesh.properties.empty()) return;
  std::cout << "numbers of the vertices\n";
  for (const VertexProperty& property : mesh.properties) {
    double least = property.values.front();
    double most = least;
    for (const double value : property.values) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
    std::cout << fmt::format("  {:<16} {:.6g} to {:.6g}\n", property.name, least, most);
  }
}

}  // namespace

int run_info(const std::vector<std::string>& arguments) {
  std::string file;
  FlagSet flags("meshnoise info", "Prints what a mesh is like, its faults, and the recipe it carries.");
  flags.argument("FILE", "The mesh, - for a .ply on the standard input", file);
  flags.parse(arguments);
  flags.apply();

  const MeshReading reading = read_mesh(file, Faces::optional);
  const MeshReport report = inspect_mesh(reading.mesh);
  const Vec<3>& lower = report.bounds.lower;
  const Vec<3>& upper = report.bounds.upper;
  std::cout << fmt::format("{} vertices, {} faces, {} edges, {}\n", report.vertices, report.faces,
                           report.edges, report.is_closed() ? "closed" : "open");
  std::cout << fmt::format("  ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", lower.x, lower.y,
                           lower.z, upper.x, upper.y, upper.z);
  std::cout << fmt::format("  mean edge {:.6g}\n", report.mean_edge_length);
  print_count("parts that share no vertex", report.components > 1 ? report.components : 0);
  print_count("edges at a boundary", report.boundary_edges);
  print_count("edges in more than two faces", report.non_manifold_edges);
  print_count("edges whose faces disagree on the outside", report.flipped_edges);
  print_count("edges of length 0", report.zero_length_edges);
  print_count("degenerate faces", report.degenerate_faces);
  print_count("duplicate faces", report.duplicate_faces);
  print_count("vertices in no face", report.isolated_vertices);
  print_properties(reading.mesh);
  for (const std::string& note : reading.notes) std::cout << "note: " << note << '\n';
  if (const auto recipe = recipe_in_comments(reading.comments)) std::cout << "recipe\n  " << *recipe << '\n';
  return kDone;
}

}  // namespace solidnoise
