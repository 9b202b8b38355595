#include "meshnoise/mesh_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include <fmt/format.h>

#include "common/outputs.h"
#include "common/run_tool.h"
#include "solidnoise/core/input_file.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/geometry/inspect_mesh.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/geometry/rewrite_mesh.h"

namespace solidnoise {

MeshReading read_input_mesh(const std::string& path, Notes notes, Faces faces) {
  MeshReading reading = read_mesh(path, faces);
  for (std::size_t v = 0; v < reading.mesh.positions.size(); ++v) {
    constexpr double kFarthest = 1e12;  // world units
    const Vec<3>& p = reading.mesh.positions[v];
    const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (farthest <= kFarthest) continue;
    throw std::runtime_error(fmt::format("{}: vertex {} has a coordinate of {:g}; it must be within +-{:g}",
                                         path, v, farthest, kFarthest));
  }
  if (notes == Notes::keep_quiet) return reading;
  for (const std::string& note : reading.notes) {
    if (!is_kept(note)) std::cerr << fmt::format("meshnoise: {}: {}\n", path, note);
  }
  for (const std::string& warning : mesh_warnings(inspect_mesh(reading.mesh))) {
    std::cerr << fmt::format("meshnoise: warning: {}: {}\n", path, warning);
  }
  return reading;
}

bool keeps_the_rest(const std::string& in, const std::string& out) {
  if (!is_mesh_path(in) || !is_mesh_path(out)) return false;
  const MeshFormat from = mesh_format(in);
  const MeshFormat to = mesh_format(out);
  if (to == MeshFormat::glb) return from == MeshFormat::glb || from == MeshFormat::gltf;
  return from == to && (to == MeshFormat::ply || to == MeshFormat::obj);
}

bool has_scene(const std::string& in) {
  return is_mesh_path(in) && (mesh_format(in) == MeshFormat::glb || mesh_format(in) == MeshFormat::gltf);
}

bool has_rest(const MeshReading& reading) {
  return std::ranges::any_of(reading.notes, is_kept);
}

void require_files_beside(const std::string& in, const std::string& out, const MeshReading& reading) {
  const auto folder_of = [](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path).parent_path());
  };
  if (reading.files.empty() || folder_of(in) == folder_of(out)) return;
  throw std::runtime_error(fmt::format("{}: it refers to {}, in its folder; --out must be there too", in,
                                       printable(reading.files.front())));
}

void print_dropped(const std::string& path, const MeshReading& reading) {
  for (const std::string& note : reading.notes) {
    if (is_kept(note)) std::cerr << fmt::format("meshnoise: {}: {}\n", path, note);
  }
}

void print_dropped_numbers(const std::string& path, const PolygonMesh& mesh, const std::string& out) {
  if (out.empty() || holds_numbers(out)) return;
  std::vector<std::string> names;
  for (const VertexProperty& property : mesh.properties) {
    const auto is_known = [&](const auto& known) {
      return std::ranges::find(known, property.name) != known.end();
    };
    if (!is_known(kNormalNames) && !is_known(kColorNames)) names.push_back(property.name);
  }
  if (names.empty()) return;
  std::cerr << fmt::format("meshnoise: {}: the vertices' {} are dropped; a .ply keeps them\n", path,
                           fmt::join(names, ", "));
}

void require_mesh_name(const std::string& out, Shows shows) {
  require_no_terminal("--out", out);
  if (out == "-") return;
  if (!is_mesh_path(out) || mesh_format(out) == MeshFormat::gltf) {
    throw UsageError(
        fmt::format("--out is {}; it must end in .ply, .obj, .off or .om, for scenes in .glb or .usda, or be "
                    "- for the standard output",
                    out));
  }
  if (shows == Shows::colors && mesh_format(out) == MeshFormat::stl) {
    throw UsageError(
        fmt::format("--out is {}; .stl holds no colours: use .ply, .obj, .off or .om, .glb or .usda", out));
  }
}

bool holds_numbers(const std::string& out) {
  if (out == "-") return true;
  if (!is_mesh_path(out)) return false;
  const MeshFormat format = mesh_format(out);
  return format != MeshFormat::obj && format != MeshFormat::off && format != MeshFormat::stl;
}

void write_output_mesh(const std::string& out, const PolygonMesh& mesh, const MeshWriteOptions& options,
                       const std::string& source) {
  if (!source.empty()) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36;
    const std::string bytes = read_file(source, kMostBytes);
    write_output(out, {.existing = options.existing, .progress = options.progress, .group = options.group},
                 [&](std::ostream& stream) {
                   rewrite_mesh(stream, bytes, mesh_format(source), source, mesh, options);
                 });
    return;
  }
  if (out != "-") return write_mesh(out, mesh, options);
  write_output("-", {.progress = options.progress},
               [&](std::ostream& stream) { write_mesh(stream, MeshFormat::ply, mesh, options); });
}

}  // namespace solidnoise
