#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <pybind11/stl.h>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arrays.h"
#include "call.h"
#include "json.h"
#include "solidnoise/core/check.h"
#include "solidnoise/core/extension.h"
#include "solidnoise/image/image_file.h"
#include "solidnoise/volume/slice/grid_slice.h"
#include "solidnoise/volume/slice/slice_image.h"
#include "solidnoise/volume/slice/slice_view.h"
#include "volume.h"

namespace solidnoise::python {

namespace {

std::optional<Vec<3>> optional_vector(const py::object& object, const std::string& name) {
  if (object.is_none()) return std::nullopt;
  return vector_of<3>(object, name);
}

// The words for Component.
Component component_of(const std::string& word) {
  const std::string words[] = {"x", "y", "z", "length"};
  for (std::size_t i = 0; i < std::size(words); ++i) {
    if (words[i] == word) return Component(i);
  }
  throw std::invalid_argument(
      fmt::format("component is {}; it must be one of {}", word, fmt::join(words, ", ")));
}

// That of a volume or a grid; none of what else is sliced.
GridObject grid_in(py::handle object, const std::optional<std::string>& name) {
  if (py::isinstance<GridObject>(object)) return object.cast<const GridObject&>();
  if (py::isinstance<VolumeObject>(object)) return find_grid(object.cast<const VolumeObject&>(), name);
  return {};
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

bool has_grids(const std::filesystem::path& path) {
  return extension_of(path) == ".vdb" || extension_of(path) == ".nvdb";
}

// What would be given for nothing.
void refuse_idle(const SliceRecipe& slice, bool is_grid, const SliceArguments& arguments,
                 const py::kwargs& keywords) {
  const auto refuse = [](const std::string& name, const char* where) {
    throw std::invalid_argument(fmt::format("{} has no effect where {} is sliced", name, where));
  };
  if (arguments.grid && is_grid) refuse("grid", "a Grid");
  if (slice.file.empty()) return;
  if (arguments.color) refuse("color", "a grid");
  for (const auto& [key, value] : keywords) refuse(key.cast<std::string>(), "a grid");
}

py::array slice_object(py::handle recipe, const SliceArguments& arguments, const Call& call,
                       const py::kwargs& keywords) {
  constexpr int kMostPixels = 16384;
  SliceRecipe slice;
  const GridObject of = grid_in(recipe, arguments.grid);
  slice.color = arguments.color;
  if (of.grid) {
    slice.file = of.file.empty() ? "the volume" : of.file;
  } else if (is_path(recipe) && has_grids(path_of(recipe))) {
    slice.file = path_of(recipe).string();
    slice.grid = arguments.grid.value_or("");
  } else {
    slice.recipe = volume_recipe_of(recipe, keywords);
    slice.grid = arguments.grid.value_or("");
  }
  refuse_idle(slice, py::isinstance<GridObject>(recipe), arguments, keywords);
  if (arguments.component) slice.component = component_of(*arguments.component);
  if (slice.file.empty()) require_sliceable(slice);
  const std::vector<double> sides = numbers_of(arguments.resolution, "resolution");
  if (sides.empty() || sides.size() > 2)
    throw std::invalid_argument("resolution must be columns, or columns and rows");
  for (const double side : sides) {
    require_in_range("resolution", side, 1, kMostPixels, "pixels");
    if (side != std::floor(side))
      throw std::invalid_argument(fmt::format("resolution is {}; it must be whole numbers", side));
  }
  slice.plane.columns = static_cast<int>(sides.front());
  slice.plane.rows = static_cast<int>(sides.back());
  if (arguments.width) require_positive("width", *arguments.width, "world units");
  const SliceView view{optional_vector(arguments.origin, "origin"),
                       optional_vector(arguments.normal, "normal"), optional_vector(arguments.up, "up"),
                       arguments.width};
  Image image;
  run(call, [&](Progress& told) {
    place_plane(view, slice);
    const SliceField field = of.grid ? make_grid_slice(slice, of.grid) : make_slice_field(slice, &told);
    if (field.bounds) fit_plane(view, *field.bounds, slice.plane);
    const std::vector<DenseField<2>> channels = sample_slice(*field.source, slice.plane, &told);
    image = channels.size() > 1 ? color_image(field, channels, {0.0, 1.0}, PixelForm::values)
                                : slice_image(slice, channels.front(), {0.0, 1.0}, PixelForm::values);
  });
  return array_of_image(std::move(image));
}

void write_picture(py::handle path, py::handle pixels, bool force) {
  const Image image = image_of_array(pixels, "pixels");
  const std::filesystem::path target = path_of(path);
  run({std::nullopt, py::none()}, [&](Progress& told) {
    write_image(target, image, {.existing = force ? Existing::replace : Existing::refuse, .progress = &told});
  });
}

}  // namespace

Image image_of_array(py::handle object, const std::string& name) {
  const py::array array = array_in(object, name);
  const char kind = array.dtype().kind();
  if (kind != 'f' && (kind != 'u' || array.itemsize() > 2))
    throw py::type_error(name + " must be of floats, uint8 or uint16");
  if (array.ndim() != 2 && array.ndim() != 3) {
    throw std::invalid_argument(name + " must have the shape (rows, columns) or (rows, columns, channels)");
  }
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
              array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1);
  image.pixels = numbers_of<float>(array, name);
  if (kind == 'f') return image;
  // As OpenImageIO does it: the same picture from a file has the same values.
  const float scale = static_cast<float>(1.0 / (array.itemsize() == 1 ? 255.0 : 65535.0));
  for (float& value : image.pixels) value *= scale;
  return image;
}

py::array array_of_image(Image&& image) {
  std::vector<py::ssize_t> shape{image.height, image.width};
  if (image.channels > 1) shape.push_back(image.channels);
  return array_of(std::move(image.pixels), shape);
}

void add_pictures(py::module_& module) {
  using namespace py::literals;
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

recipe : as of make_volume(); or a Volume, a Grid, or the path of a .vdb or .nvdb
    What its voxels would be filled with, densities before they are scaled; or whose grid is sliced.
origin : 3 floats, world units
    The middle; left out, 0, or the middle of the grid, or of the box of a density.
normal, up : 3 floats
    Towards the viewer, along z by default, and what is up.
width : float, world units
    Of the picture; left out, 2, the noise's period, or that of the grid, or of the box of a density.
resolution : int, or columns and rows
grid, component : str
    Of a volume or a recipe: the grid; of vectors x, y, z or length alone.
color : bool
    Of a noise alone: three channels: an exemplar's own colours, in linear light, or three independent noises.

Returns an array (rows, columns), or (rows, columns, 3), of float32, row 0 at the top.)");
  module.def("write_image", &write_picture, "path"_a, "pixels"_a, py::kw_only(), "force"_a = false,
             R"(write_image(path, pixels, *, force=False)
--

Writes an array (rows, columns) or (rows, columns, channels) as a picture: .png, .jpg and .tif take 0 to 1, sRGB-encoded; .exr any
values. Of uint8 and uint16 the largest number is 1. All or nothing. Raises OSError, FileExistsError.)");
}

}  // namespace solidnoise::python
