#include "volume.h"

#include <filesystem>
#include <pybind11/stl.h>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "call.h"
#include "json.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/core/printable.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/preview/picture.h"
#include "solidnoise/volume/volume_recipe_json.h"

namespace solidnoise::python {

std::vector<GridObject> VolumeObject::grids() const {
  std::vector<GridObject> result;
  if (volume.file) {
    for (const auto& grid : volume.file->grids) result.push_back({grid, file});
  } else {
    for (const MeasuredGrid& measured : volume.grids) result.push_back({measured.grid, file});
  }
  return result;
}

// The grid of a name, or the first one.
GridObject find_grid(const VolumeObject& volume, const std::optional<std::string>& name) {
  const std::vector<GridObject> grids = volume.grids();
  std::vector<std::string> names;
  for (const GridObject& grid : grids) {
    if (!name || grid.grid->getName() == *name) return grid;
    names.push_back(grid.grid->getName());
  }
  throw std::invalid_argument(
      fmt::format("grid is {}; it must be one of {}", name.value_or(""), fmt::join(names, ", ")));
}

namespace {

struct FrameNote {
  std::optional<int> frame;
  std::optional<double> fps;
};

void write_volume_object(const VolumeObject& volume, py::handle path, bool force, const FrameNote& note,
                         const Call& call) {
  const std::filesystem::path target = path_of(path);
  const bool is_nvdb = extension_of(target) == ".nvdb";
  if (!is_nvdb && extension_of(target) != ".vdb") {
    throw std::invalid_argument(
        fmt::format("path is {}; it must end in .vdb or .nvdb", printable(target.string())));
  }
  if (note.fps) require_positive("fps", *note.fps, "frames per second");
  if (is_nvdb && (note.frame || note.fps)) {
    throw std::invalid_argument("frame and fps are of a .vdb; a .nvdb has no place for them");
  }
  VdbWriteOptions options;
  if (volume.recipe) options.codec = volume.recipe->codec;
  options.existing = force ? Existing::replace : Existing::refuse;
  options.creator = kCreator;
  options.frame = note.frame ? note.frame : volume.frame;
  options.fps = note.fps ? note.fps : volume.fps;
  run(call, [&](Progress& told) {
    options.progress = &told;
    if (is_nvdb) {
      write_nvdb(target, volume.volume, {.existing = options.existing, .progress = &told});
    } else {
      write_volume(target, volume.volume, options);
    }
  });
}

std::string represent(const VolumeObject& volume) {
  std::vector<std::string> grids;
  for (const GridObject& of : volume.grids()) {
    const openvdb::Coord dim = of.grid->evalActiveVoxelDim();
    grids.push_back(fmt::format("{} {} x {} x {}", of.grid->getName(), dim.x(), dim.y(), dim.z()));
  }
  return fmt::format("<solidnoise.Volume {}>", fmt::join(grids, ", "));
}

// By a file, which is exact: grids cannot be handed to another kind of binding.
py::object to_pyopenvdb(const VolumeObject& volume) {
  const py::module_ pyopenvdb = py::module_::import("pyopenvdb");
  const py::object folder = py::module_::import("tempfile").attr("TemporaryDirectory")();
  const std::filesystem::path path = path_of(folder.attr("name")) / "volume.vdb";
  VdbWriteOptions options;
  options.codec = Codec::none;
  run({std::nullopt, py::none()}, [&](Progress& told) {
    options.progress = &told;
    write_volume(path, volume.volume, options);
  });
  const py::object grids = pyopenvdb.attr("readAll")(path.string())[py::int_(0)];
  folder.attr("cleanup")();
  return grids;
}

py::array preview(const VolumeObject& volume, std::optional<int> threads, py::object progress) {
  if (!volume.recipe || volume.volume.grids.empty()) {
    throw std::invalid_argument("a preview needs a volume that was made or merged, not read");
  }
  Image image;
  run({threads, std::move(progress)},
      [&](Progress& told) { image = picture_of(volume.volume, *volume.recipe, nullptr, &told); });
  return array_of_image(std::move(image));
}

void add_volume_class(py::module_& module) {
  using namespace py::literals;
  py::class_<VolumeObject> of(
      module, "Volume", py::custom_type_setup(&refuse_empty),
      R"(A volume: one or several grids of the same voxels. make_volume(), merge() and read_volume() make them.

    volume.grids["density"].to_numpy()     # an array (x, y, z)
    volume.write("cloud.vdb"))");
  of.def_property_readonly(
      "grids",
      [](const VolumeObject& volume) {
        py::dict result;
        for (const GridObject& grid : volume.grids()) result[py::str(grid.grid->getName())] = py::cast(grid);
        return result;
      },
      "The grids by their names, in the file's order.");
  of.def_property_readonly(
      "recipe",
      [](const VolumeObject& volume) -> py::object {
        return volume.recipe ? object_of(to_json(*volume.recipe)) : py::none();
      },
      "The recipe that makes the volume again, as a new dict; None of a file that carries none.");
  of.def(
      "to_numpy",
      [](const VolumeObject& volume, const std::optional<std::string>& grid, std::optional<int> threads,
         py::object progress) {
        return to_numpy(find_grid(volume, grid), py::none(), {threads, std::move(progress)});
      },
      "grid"_a = py::none(), py::kw_only(), "threads"_a = py::none(), "progress"_a = py::none(),
      R"(to_numpy(self, grid=None, *, threads=None, progress=None)
--

The values of the grid of this name, or of the first one: see Grid.to_numpy().)");
  of.def(
      "write",
      [](const VolumeObject& volume, py::handle path, bool force, std::optional<int> frame,
         std::optional<double> fps, std::optional<int> threads, py::object progress) {
        write_volume_object(volume, path, force, {frame, fps}, {threads, std::move(progress)});
      },
      "path"_a, py::kw_only(), "force"_a = false, "frame"_a = py::none(), "fps"_a = py::none(),
      "threads"_a = py::none(), "progress"_a = py::none(),
      R"(write(self, path, *, force=False, frame=None, fps=None, threads=None, progress=None)
--

Writes the volume to a .vdb, or, as NanoVDB, to a .nvdb, which has no place for recipe, frame and fps; all or nothing.

force : bool
    Whether a file that exists is replaced; without it, FileExistsError is raised.
frame : int, fps : float, above 0
    Noted in the file.
threads, progress
    As of Noise.

Raises OSError for a file that cannot be written.)");
  of.def("to_pyopenvdb", &to_pyopenvdb, R"(to_pyopenvdb(self)
--

The grids as a list of those of the module pyopenvdb, copied. Raises ImportError where it is not installed.)");
  of.def("preview", &preview, py::kw_only(), "threads"_a = py::none(), "progress"_a = py::none(),
         R"(preview(self, *, threads=None, progress=None)
--

A picture of the volume, as vdbnoise --preview makes it: an array (rows, columns, 3) of float32, sRGB-encoded, 0 to 1, row 0 at the
top; of clouds and surfaces (480, 480, 3), where slices show more as those are.)");
  of.def("__repr__", [](const VolumeObject& volume) { return represent(volume); });
}

}  // namespace

void add_volume(py::module_& module) {
  add_grid(module);
  add_volume_class(module);
  add_makers(module);
  add_measures(module);
  add_pictures(module);
  add_field(module);
}

}  // namespace solidnoise::python
