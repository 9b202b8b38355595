#include <memory>
#include <optional>
#include <string>

#include "common/field_flags.h"
#include "common/outputs.h"
#include "common/run_options.h"
#include "common/run_tool.h"
#include "solidnoise/volume/topology/grid_frame.h"
#include "solidnoise/volume/topology/mesh_level_set.h"
#include "solidnoise/volume/topology/triangle_mesh.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "vdbnoise/commands.h"
#include "vdbnoise/volume_output.h"

namespace solidnoise {
namespace {

constexpr char kSurfaceDescription[] =
    "Makes the level set of a closed mesh: distances to its surface, negative inside. For --displace and\n"
    "--boundary; and, of a wide band, for --frequency-grid.\n"
    "  vdbnoise surface bunny.obj --out bunny.vdb --band 0.2";

struct SurfaceOptions : RunOptions {
  std::string mesh;
  std::string out;
  std::string grid = "surface";
  std::optional<double> voxel;
  int dim = 256;
  std::optional<double> band;
};

constexpr auto fields_of(std::type_identity<SurfaceOptions>) {
  using Options = SurfaceOptions;
  return list_fields(
      field("voxel", &Options::voxel, kPositive, "world units", "Size of a voxel"),
      field("dim", &Options::dim, between(1, 1 << 20), "voxels", "Along the mesh's longest side instead"),
      field("band", &Options::band, kPositive, "world units",
            "How far distances reach on both sides, 3 to 1000 voxels; without it, 3"),
      field("grid", &Options::grid, "Name of the grid"));
}

void declare(FlagSet& flags, SurfaceOptions& options) {
  flags.argument("MESH", "A closed mesh: .ply, .obj, .off, .stl or .om", options.mesh);
  flags.keep("--out", "FILE.vdb", "Where the grid goes; - for the standard output", options.out);
  declare_fields(flags, options);
  flags.exclude({"--voxel", "--dim"});
  declare_fields<RunOptions>(flags, options, {"force", "max_memory", "max_time", "quiet"});
}

}  // namespace

int run_surface(const std::vector<std::string>& arguments) {
  SurfaceOptions options;
  FlagSet flags("vdbnoise surface", kSurfaceDescription);
  declare(flags, options);
  flags.parse(arguments);
  flags.apply();
  if (options.out.empty()) throw UsageError("--out is missing; say where the grid goes: --out surface.vdb");
  check_output_names(options.out, "");
  require_outputs({options.out}, options.existing(), {options.mesh});
  catch_interrupts();

  auto ends_at_once = std::make_unique<EndsAtOnce>();
  const TriangleMesh mesh = read_closed_mesh(options.mesh);
  Volume volume;
  {
    TaskProgress progress(options.visibility());
    progress.begin("distances");
    const openvdb::FloatGrid::Ptr grid = flags.explained([&] {
      const double voxel = options.voxel ? *options.voxel : voxel_size_for_dim(mesh.bounds(), options.dim);
      const double band = options.band.value_or(3.0 * voxel);
      const Cost cost = level_set_cost(mesh, voxel, band);
      options.require_cost("the level set", cost, "make --dim or --band smaller");
      return mesh_level_set(mesh, voxel, band, &progress);
    });
    grid->setName(options.grid);
    grid->setCreator(kVdbnoise);
    volume.grids.push_back({grid, {measure(*grid)}});
    progress.begin("writing");
    ends_at_once.reset();
    VdbWriteOptions write;
    write.existing = options.existing();
    write.creator = kVdbnoise;
    write.progress = &progress;
    write_volume(options.out, volume, write);
  }
  if (!options.quiet) print_statistics(volume, options.out);
  return kDone;
}

}  // namespace solidnoise
