#include "volume.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <pybind11/stl.h>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <openvdb/tools/Dense.h>

#include "arrays.h"
#include "call.h"
#include "documentation.h"
#include "json.h"
#include "solidnoise/core/check.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/recipe/recipe_file.h"
#include "solidnoise/volume/analyze_volume.h"
#include "solidnoise/volume/describe_volume.h"
#include "solidnoise/volume/make_volume.h"
#include "solidnoise/volume/merge_parts.h"
#include "solidnoise/volume/preview/picture.h"
#include "solidnoise/volume/slice/slice_image.h"
#include "solidnoise/volume/slice/slice_view.h"
#include "solidnoise/volume/stored_recipe.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "solidnoise/volume/vdb/vdb_read.h"
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

namespace {

// A volume's recipe, as use_recipe() has it. Files may be volumes, too, which carry theirs; a dict need not
// say of which version it is.
VolumeRecipe volume_recipe_of(py::handle recipe, const py::dict& keywords) {
  const auto text_in = [](const std::filesystem::path& path) {
    return path.extension() == ".vdb" ? recipe_text_in(path) : read_text_file(path);
  };
  VolumeRecipe result;
  use_recipe(
      recipe, keywords, [&](const Json& json) { result = volume_recipe_from_json(with_header(json)); },
      text_in);
  return result;
}

VolumePart part_of(std::optional<std::pair<int, int>> shard) {
  VolumePart part;
  if (shard) std::tie(part.shard, part.shards) = *shard;
  part.validate();
  return part;
}

VolumeObject make_volume_object(py::handle recipe, std::optional<std::pair<int, int>> shard,
                                std::optional<int> threads, py::object progress, const py::kwargs& keywords) {
  const Call call(threads, std::move(progress));
  const VolumeRecipe read = volume_recipe_of(recipe, keywords);
  const VolumePart part = part_of(shard);
  VolumeObject made;
  run(call, [&](Progress& told) {
    const VolumePlan plan = plan_volume(read, part);
    made.volume = make_volume(read, plan, kCreator, &told);
    made.recipe = with_digests(read, plan);
  });
  return made;
}

VolumeObject read_volume_object(py::handle path, std::optional<int> threads) {
  VolumeObject result;
  const std::filesystem::path file = path_of(path);
  result.file = file.string();
  run({threads, py::none()}, [&](Progress&) {
    result.volume.file = read_grids(file);
    for (const auto& grid : result.volume.file->grids) {
      if (!result.recipe) result.recipe = stored_recipe(*grid, result.file);
    }
  });
  return result;
}

VolumeObject merge_volume_object(const py::iterable& paths, std::optional<int> threads, py::object progress) {
  std::vector<std::filesystem::path> files;
  for (const py::handle path : paths) files.push_back(path_of(path));
  VolumeObject result;
  run({threads, std::move(progress)}, [&](Progress& told) {
    MergedVolume merged = merge_parts(files, kCreator, &told);
    result.volume = std::move(merged.volume);
    result.recipe = std::move(merged.recipe);
    result.frame = merged.frame;
    result.fps = merged.fps;
  });
  return result;
}

py::object describe_object(py::handle recipe, const py::kwargs& keywords) {
  const VolumeRecipe read = volume_recipe_of(recipe, keywords);
  Json json;
  run({std::nullopt, py::none()}, [&](Progress&) { json = describe_volume(read); });
  return object_of(json);
}

void write_volume_object(const VolumeObject& volume, py::handle path, bool force, std::optional<int> frame,
                         std::optional<double> fps, py::object progress) {
  VdbWriteOptions options;
  if (volume.recipe) options.codec = volume.recipe->codec;
  options.existing = force ? Existing::replace : Existing::refuse;
  options.creator = kCreator;
  options.frame = frame ? frame : volume.frame;
  options.fps = fps ? fps : volume.fps;
  const std::filesystem::path target = path_of(path);
  run({std::nullopt, std::move(progress)}, [&](Progress& told) {
    options.progress = &told;
    write_volume(target, volume.volume, options);
  });
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

py::tuple tuple_of(const openvdb::Coord& c) {
  return py::make_tuple(c.x(), c.y(), c.z());
}
py::tuple tuple_of(const openvdb::Vec3d& v) {
  return py::make_tuple(v.x(), v.y(), v.z());
}

// Copies the voxels of a box, active or not, in parallel.
template <typename Grid, typename Number>
void copy_dense(const Grid& grid, const openvdb::CoordBBox& box, Number* memory) {
  using Value = typename Grid::ValueType;
  static_assert(sizeof(Value) % sizeof(Number) == 0);
  openvdb::tools::Dense<Value, openvdb::tools::LayoutZYX> dense(box, reinterpret_cast<Value*>(memory));
  openvdb::tools::copyToDense(grid, dense);
}

py::array to_numpy(const GridObject& of, const py::object& bounds) {
  openvdb::CoordBBox box = of.grid->evalActiveVoxelBoundingBox();
  if (!bounds.is_none()) {
    const auto corners = bounds.cast<std::pair<std::array<int, 3>, std::array<int, 3>>>();
    box = {openvdb::Coord(corners.first.data()), openvdb::Coord(corners.second.data())};
  }
  const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(of.grid);
  const auto vectors = in_single_precision(*of.grid);
  if (!floats && !vectors) {
    throw std::invalid_argument(fmt::format("grid {} is of {}; it must be of float or vectors",
                                            of.grid->getName(), of.grid->valueType()));
  }
  const bool empty = box.empty();
  std::vector<py::ssize_t> shape(3, 0);
  for (std::size_t axis = 0; !empty && axis < 3; ++axis) shape[axis] = box.dim()[static_cast<int>(axis)];
  if (vectors) shape.push_back(3);
  py::array_t<float> array(shape);
  if (empty) return array;
  float* const memory = array.mutable_data();
  run({std::nullopt, py::none()}, [&](Progress&) {
    if (floats) return copy_dense(*floats, box, memory);
    copy_dense(*vectors, box, memory);
  });
  return array;
}

py::object bounds_of(const GridObject& of) {
  const openvdb::CoordBBox box = of.grid->evalActiveVoxelBoundingBox();
  if (box.empty()) return py::none();
  return py::make_tuple(tuple_of(box.min()), tuple_of(box.max()));
}

py::object origin_of(const GridObject& of) {
  const openvdb::CoordBBox box = of.grid->evalActiveVoxelBoundingBox();
  if (box.empty()) return py::none();
  return tuple_of(of.grid->indexToWorld(box.min()));
}

py::dict metadata_of(const openvdb::MetaMap& of) {
  py::dict result;
  for (auto item = of.beginMeta(); item != of.endMeta(); ++item) {
    const std::string& name = item->first;
    const auto number = [&]<typename Number>(std::type_identity<Number>) {
      const auto typed = of.getMetadata<openvdb::TypedMetadata<Number>>(name);
      if (typed) result[py::str(name)] = py::cast(typed->value());
      return typed != nullptr;
    };
    if (number(std::type_identity<std::string>()) || number(std::type_identity<std::int64_t>()) ||
        number(std::type_identity<std::int32_t>()) || number(std::type_identity<double>()) ||
        number(std::type_identity<float>()) || number(std::type_identity<bool>())) {
      continue;
    }
    result[py::str(name)] = item->second->str();
  }
  return result;
}

std::string represent(const GridObject& of) {
  return fmt::format("<solidnoise.Grid {}, {} of {}, {} active voxels>", of.grid->getName(),
                     openvdb::GridBase::gridClassToString(of.grid->getGridClass()), of.grid->valueType(),
                     of.grid->activeVoxelCount());
}

std::string represent(const VolumeObject& volume) {
  std::vector<std::string> grids;
  for (const GridObject& of : volume.grids()) {
    const openvdb::Coord dim = of.grid->evalActiveVoxelDim();
    grids.push_back(fmt::format("{} {} x {} x {}", of.grid->getName(), dim.x(), dim.y(), dim.z()));
  }
  return fmt::format("<solidnoise.Volume {}>", fmt::join(grids, ", "));
}

py::array array_of_image(Image&& image) {
  std::vector<py::ssize_t> shape{image.height, image.width};
  if (image.channels > 1) shape.push_back(image.channels);
  return array_of(std::move(image.pixels), shape);
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

py::array preview(const VolumeObject& volume, py::object progress) {
  if (!volume.recipe || volume.volume.grids.empty()) {
    throw std::invalid_argument("a preview needs a volume that was made or merged, not read");
  }
  Image image;
  run({std::nullopt, std::move(progress)},
      [&](Progress& told) { image = picture_of(volume.volume, *volume.recipe, nullptr, &told); });
  return array_of_image(std::move(image));
}

py::object analyze_grid(const GridObject& of) {
  const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(of.grid);
  if (!floats) {
    throw std::invalid_argument(
        fmt::format("grid {} is of {}; it must be of float", of.grid->getName(), of.grid->valueType()));
  }
  Json json;
  run({std::nullopt, py::none()}, [&](Progress&) { json = analyze(analysis_subject(floats, of.file)).json; });
  return object_of(json);
}

py::object analyze_any(const py::object& what, const std::optional<std::string>& grid) {
  if (py::isinstance<GridObject>(what)) return analyze_grid(what.cast<const GridObject&>());
  if (py::isinstance<VolumeObject>(what))
    return analyze_grid(find_grid(what.cast<const VolumeObject&>(), grid));
  const std::filesystem::path path = path_of(what);
  GridObject of{nullptr, path.string()};
  run({std::nullopt, py::none()}, [&](Progress&) { of.grid = read_float_grid(path, grid.value_or("")); });
  return analyze_grid(of);
}

std::optional<Vec<3>> optional_vector(const py::object& object, const std::string& name) {
  if (object.is_none()) return std::nullopt;
  return vector_of<3>(object, name);
}

// The words for SliceRecipe::Component.
SliceRecipe::Component component_of(const std::string& word) {
  const std::string words[] = {"x", "y", "z", "length"};
  for (std::size_t i = 0; i < std::size(words); ++i) {
    if (words[i] == word) return SliceRecipe::Component(i);
  }
  throw std::invalid_argument(
      fmt::format("component is {}; it must be one of {}", word, fmt::join(words, ", ")));
}

struct SliceArguments {
  py::object origin;
  py::object normal;
  py::object up;
  std::optional<double> width;
  py::object resolution;
  std::optional<std::string> grid;
  std::optional<std::string> component;
  bool color;
};

py::array slice_object(py::handle recipe, const SliceArguments& arguments, const Call& call,
                       const py::kwargs& keywords) {
  constexpr int kMostPixels = 16384;
  SliceRecipe slice;
  if (is_path(recipe) && path_of(recipe).extension() == ".vdb") {
    slice.file = path_of(recipe).string();
    slice.grid = arguments.grid.value_or("");
  } else {
    slice.recipe = volume_recipe_of(recipe, keywords);
    if (!std::holds_alternative<RawShaping>(slice.recipe.shaping) || !slice.recipe.grids.empty()) {
      throw std::invalid_argument(
          "the recipe shapes its noise, or has several grids; slice the volume that it makes");
    }
  }
  if (arguments.component) slice.component = component_of(*arguments.component);
  slice.color = arguments.color;
  const std::vector<double> sides = numbers_of(arguments.resolution, "resolution");
  if (sides.empty() || sides.size() > 2)
    throw std::invalid_argument("resolution must be columns, or columns and rows");
  for (const double side : sides) require_in_range("resolution", side, 1, kMostPixels, "pixels");
  slice.plane.columns = static_cast<int>(sides.front());
  slice.plane.rows = static_cast<int>(sides.back());
  if (arguments.width) require_positive("width", *arguments.width, "world units");
  const SliceView view{optional_vector(arguments.origin, "origin"),
                       optional_vector(arguments.normal, "normal"), optional_vector(arguments.up, "up"),
                       arguments.width};
  Image image;
  run(call, [&](Progress& told) {
    place_plane(view, slice);
    const std::vector<SliceField> fields = make_slice_fields(slice);
    if (fields.front().bounds) fit_plane(view, *fields.front().bounds, slice.plane);
    std::vector<DenseField<2>> channels;
    for (const SliceField& field : fields)
      channels.push_back(sample_slice(*field.source, slice.plane, &told));
    image = fields.size() > 1 ? color_image(slice, channels, {0.0, 1.0}, PixelForm::values)
                              : slice_image(slice, channels.front(), {0.0, 1.0}, PixelForm::values);
  });
  return array_of_image(std::move(image));
}

void write_picture(py::handle path, py::handle pixels, bool force) {
  const auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(pixels);
  if (!array) throw py::error_already_set();
  if (array.ndim() != 2 && array.ndim() != 3) {
    throw std::invalid_argument("pixels must have the shape (rows, columns) or (rows, columns, channels)");
  }
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
              array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1);
  std::copy_n(array.data(), image.pixels.size(), image.pixels.begin());
  const std::filesystem::path target = path_of(path);
  run({std::nullopt, py::none()}, [&](Progress&) {
    write_image(target, image, {.existing = force ? Existing::replace : Existing::refuse});
  });
}

void add_grid(py::module_& module) {
  using namespace py::literals;
  py::class_<GridObject> of(module, "Grid",
                            "A grid of a volume. What it holds belongs to the volume; to_numpy() copies it.");
  const auto property = [&](const char* name, auto get, const char* text) {
    of.def_property_readonly(name, get, text);
  };
  property(
      "name", [](const GridObject& g) { return g.grid->getName(); }, "Its name, such as density.");
  property(
      "value_type", [](const GridObject& g) { return g.grid->valueType(); }, "OpenVDB's: float, vec3s, ...");
  property(
      "grid_class",
      [](const GridObject& g) { return openvdb::GridBase::gridClassToString(g.grid->getGridClass()); },
      "OpenVDB's: fog volume, level set, unknown, ...");
  property(
      "voxel_size", [](const GridObject& g) { return tuple_of(g.grid->voxelSize()); },
      "World units along x, y, z.");
  property(
      "active_voxels", [](const GridObject& g) { return g.grid->activeVoxelCount(); },
      "How many voxels are active.");
  property("bounds", &bounds_of,
           "The first and the last voxel, as indices, of the box of active voxels; None if there are none.");
  property("origin", &origin_of,
           "Where the centre of the first of these is, world units: that of to_numpy()[0, 0, 0].");
  property(
      "metadata", [](const GridObject& g) { return metadata_of(*g.grid); },
      "What the file says of it, as a new dict.");
  of.def("to_numpy", &to_numpy, "bounds"_a = py::none(), R"(to_numpy(self, bounds=None)
--

The values of a box of voxels, active or not, as a new array of float32: (x, y, z), or (x, y, z, 3) of vectors.

bounds : two tuples of 3 ints
    The first and the last voxel; left out, the box of active voxels.)");
  of.def("__repr__", [](const GridObject& g) { return represent(g); });
}

void add_volume_class(py::module_& module) {
  using namespace py::literals;
  py::class_<VolumeObject> of(
      module, "Volume",
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
      [](const VolumeObject& volume, const std::optional<std::string>& grid) {
        return to_numpy(find_grid(volume, grid), py::none());
      },
      "grid"_a = py::none(), R"(to_numpy(self, grid=None)
--

The values of the grid of this name, or of the first one: see Grid.to_numpy().)");
  of.def("write", &write_volume_object, "path"_a, py::kw_only(), "force"_a = false, "frame"_a = py::none(),
         "fps"_a = py::none(), "progress"_a = py::none(),
         R"(write(self, path, *, force=False, frame=None, fps=None, progress=None)
--

Writes the volume to a .vdb, all or nothing.

force : bool
    Whether a file that exists is replaced; without it, FileExistsError is raised.
frame : int, fps : float
    Noted in the file.

Raises OSError for a file that cannot be written.)");
  of.def("to_pyopenvdb", &to_pyopenvdb, R"(to_pyopenvdb(self)
--

The grids as a list of those of the module pyopenvdb, copied. Raises ImportError where it is not installed.)");
  of.def("preview", &preview, py::kw_only(), "progress"_a = py::none(), R"(preview(self, *, progress=None)
--

A picture of the volume, as vdbnoise --preview makes it: an array (480, 480, 3) of float32, sRGB-encoded, 0 to 1, row 0 at the top.)");
  of.def("__repr__", [](const VolumeObject& volume) { return represent(volume); });
}

void add_functions(py::module_& module) {
  using namespace py::literals;
  const std::string keys = describe_options(volume_recipe_schema());
  module.def("make_volume", &make_volume_object, "recipe"_a = py::none(), py::kw_only(),
             "shard"_a = py::none(), "threads"_a = py::none(), "progress"_a = py::none(),
             document("make_volume(recipe=None, *, shard=None, threads=None, progress=None, **keys)",
                      R"(Makes a volume of a recipe: the same values, to the last bit, as vdbnoise --recipe.

    solidnoise.make_volume(solidnoise.preset("smoke"), dim=128, noise={"seed": 7}).write("smoke.vdb")

recipe : dict, or the path of a .json file, or of a .vdb that carries one
    What vdbnoise reads and writes. Left out, all keys are as they are by default.
shard : two ints
    A part of the volume, (1, 8) for the first of eight, for merge().
threads, progress
    As of Noise.
keys
    Of the recipe: take the place of its own, or, where both are dicts, are merged into them.

The keys of a recipe:

)" + keys +
                          "\nReturns a Volume. Raises ValueError for a recipe that is not allowed, OSError "
                          "for files that it names.")
                 .c_str());
  module.def("describe", &describe_object, "recipe"_a = py::none(),
             R"(describe(recipe=None, **keys)
--

What a recipe, as of make_volume(), would make, without making it: a dict with the noise's kernel and statistics in closed form, voxels,
memory and seconds.)");
  module.def("read_volume", &read_volume_object, "path"_a, py::kw_only(), "threads"_a = py::none(),
             R"(read_volume(path, *, threads=None)
--

Reads all grids of a .vdb, whoever made it. Raises OSError for a file that cannot be read, or that is damaged.)");
  module.def("merge", &merge_volume_object, "paths"_a, py::kw_only(), "threads"_a = py::none(),
             "progress"_a = py::none(),
             R"(merge(paths, *, threads=None, progress=None)
--

Joins the files of a volume's parts (shard=), in any order: the same volume, to the last bit, as made whole. Raises OSError for a part
that is missing or is not one.)");
  module.def("analyze", &analyze_any, "what"_a, "grid"_a = py::none(), R"(analyze(what, grid=None)
--

Measures a grid of floats: moments, histogram and radial power spectrum, each beside the closed form of the recipe that it carries.

what : Grid, Volume, or the path of a .vdb
grid : str
    The name of the grid; left out, the first one.

Returns a dict, what vdbnoise analyze prints.)");
  module.def(
      "slice",
      [](py::handle recipe, py::object origin, py::object normal, py::object up, std::optional<double> width,
         py::object resolution, std::optional<std::string> grid, std::optional<std::string> component,
         bool color, std::optional<int> threads, py::object progress, const py::kwargs& keywords) {
        return slice_object(recipe,
                            {std::move(origin), std::move(normal), std::move(up), width,
                             std::move(resolution), std::move(grid), std::move(component), color},
                            {threads, std::move(progress)}, keywords);
      },
      "recipe"_a, py::kw_only(), "origin"_a = py::none(), "normal"_a = py::none(), "up"_a = py::none(),
      "width"_a = py::none(), "resolution"_a = 512, "grid"_a = py::none(), "component"_a = py::none(),
      "color"_a = false, "threads"_a = py::none(), "progress"_a = py::none(),
      R"(slice(recipe, *, origin=None, normal=None, up=None, width=None, resolution=512, grid=None, component=None, color=False, threads=None, progress=None, **keys)
--

The values on a plane, at the centres of square pixels.

recipe : as of make_volume(), of raw noise; or the path of a .vdb
    Whose noise, or whose grid, is sliced.
origin : 3 floats, world units
    The middle; left out, 0, or the middle of the grid.
normal, up : 3 floats
    Towards the viewer, along z by default, and what is up.
width : float, world units
    Of the picture; left out, 2, the noise's period, or that of the grid.
resolution : int, or columns and rows
grid, component : str
    Of a .vdb: the grid; of vectors x, y, z or length alone.
color : bool
    Three channels: an exemplar's own colours, in linear light, or three independent noises.

Returns an array (rows, columns), or (rows, columns, 3), of float32, row 0 at the top.)");
  module.def("write_image", &write_picture, "path"_a, "pixels"_a, py::kw_only(), "force"_a = false,
             R"(write_image(path, pixels, *, force=False)
--

Writes an array (rows, columns) or (rows, columns, channels) as a picture: .png, .jpg and .tif take 0 to 1, sRGB-encoded; .exr any
values. All or nothing. Raises OSError, FileExistsError.)");
}

}  // namespace

void add_volume(py::module_& module) {
  add_grid(module);
  add_volume_class(module);
  add_functions(module);
}

}  // namespace solidnoise::python
