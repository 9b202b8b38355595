#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/flag_set.h"
#include "common/memory.h"
#include "common/outputs.h"
#include "common/parse_value.h"
#include "common/progress.h"
#include "common/run_tool.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/mesh_level_set.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

constexpr char kDescription[] =
    "Makes the level set of a closed mesh: distances to its surface, negative inside. For --displace and\n"
    "--boundary; and, of a wide band, for --frequency-grid.\n"
    "  vdbnoise surface bunny.obj --out bunny.vdb --band 0.2";

struct SurfaceOptions {
  std::string mesh;
  std::string out;
  std::string grid = "surface";
  std::optional<double> voxel;
  int dim = 256;
  std::optional<double> band;
  Existing existing = Existing::refuse;
  std::uint64_t max_memory = 0;  // bytes; 0: what the machine has available
  bool quiet = false;
};

void declare(FlagSet& flags, SurfaceOptions& options) {
  flags.argument("MESH", "A closed mesh: .ply, .obj, .off, .stl or .om", options.mesh);
  flags.group("Flags");
  keep(flags, "--out", "FILE.vdb", "Where the grid goes; - for the standard output", options.out);
  flags.number("--voxel", "SIZE", "Size of a voxel, world units", [&](double size) { options.voxel = size; });
  flags.integer("--dim", "COUNT", "Voxels along the mesh's longest side instead (default 256)",
                [&](int count) { options.dim = count; });
  flags.exclude({"--voxel", "--dim"});
  flags.number("--band", "UNITS",
               "How far distances reach on both sides, world units, 3 to 1000 voxels (default 3 voxels)",
               [&](double band) { options.band = band; });
  keep(flags, "--grid", "NAME", "Name of the grid (default surface)", options.grid);
  flags.toggle("--force", "Replace a file that exists", [&] { options.existing = Existing::replace; });
  flags.text("--max-memory", "SIZE", "Refuse to need more than this, such as 8G (default: what is available)",
             [&](const std::string& text) { options.max_memory = parse_bytes("--max-memory", text); });
  flags.toggle("--quiet", "Print errors only", [&] { options.quiet = true; });
}

TriangleMesh read_triangles(const std::string& file) {
  PolygonMesh mesh = read_mesh(file).mesh;
  TriangleMesh result{std::move(mesh.positions), triangulate(mesh)};
  try {
    require_closed(result);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  }
  return result;
}

void check_memory(std::uint64_t needed, std::uint64_t allowed) {
  const std::uint64_t limit = allowed != 0 ? allowed : available_memory();
  if (limit == 0 || needed <= limit) return;
  throw std::runtime_error(
      fmt::format("the level set may need {}, --max-memory allows {}{}; make --dim or --band smaller",
                  format_bytes(needed), format_bytes(limit), allowed != 0 ? "" : ", what is available"));
}

}  // namespace

int run_surface(const std::vector<std::string>& arguments) {
  SurfaceOptions options;
  FlagSet flags("vdbnoise surface", kDescription);
  declare(flags, options);
  flags.parse(arguments);
  flags.apply();
  if (options.out.empty()) throw UsageError("--out is missing; say where the grid goes: --out surface.vdb");
  check_output_names(options.out, "");
  require_outputs({options.out}, options.existing, {options.mesh});
  catch_interrupts();

  auto ends_at_once = std::make_unique<EndsAtOnce>();
  const TriangleMesh mesh = read_triangles(options.mesh);
  Volume volume;
  {
    TaskProgress progress(options.quiet ? ProgressBar::Visibility::hidden
                                        : ProgressBar::Visibility::if_terminal);
    progress.begin("distances");
    openvdb::FloatGrid::Ptr grid;
    try {
      const double voxel = options.voxel ? *options.voxel : voxel_size_for_dim(mesh.bounds(), options.dim);
      const double band = options.band.value_or(3.0 * voxel);
      check_memory(estimate_level_set_memory(mesh, voxel, band), options.max_memory);
      grid = mesh_level_set(mesh, voxel, band, &progress);
    } catch (const std::invalid_argument& error) {
      throw UsageError(flags.name_flag(error.what()));
    }
    grid->setName(options.grid);
    grid->setCreator(kVdbnoise);
    volume.grids.push_back({grid, {measure(*grid)}});
    progress.begin("writing");
    ends_at_once.reset();
    VdbWriteOptions write;
    write.existing = options.existing;
    write.creator = kVdbnoise;
    write.progress = &progress;
    write_volume(options.out, volume, write);
  }
  if (!options.quiet) print_statistics(volume, options.out);
  return kDone;
}

}  // namespace solidnoise
