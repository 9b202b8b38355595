#pragma once

#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "call.h"
#include "solidnoise/core/image.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/volume/volume.h"
#include "solidnoise/volume/volume_recipe.h"

namespace solidnoise::python {

namespace py = pybind11;

// A grid as callers hold it.
struct GridObject {
  openvdb::GridBase::Ptr grid;
  std::string file;  // that it is from; empty: none
};

// A volume as callers hold it: made, merged or read.
struct VolumeObject {
  Volume volume;
  std::optional<VolumeRecipe> recipe;  // none: it was read from a file that carries none
  std::string file;
  std::optional<int> frame;
  std::optional<double> fps;

  // Those of the file, where a grid of it was modified, or else those that were made.
  std::vector<GridObject> grids() const;
};

// A volume's recipe, as use_recipe() has it. Files may be volumes, too, which carry theirs; a dict need not
// say of which version it is.
VolumeRecipe volume_recipe_of(py::handle recipe, const py::dict& keywords);

// The grid of a name, or the first one.
GridObject find_grid(const VolumeObject& volume, const std::optional<std::string>& name);

// The voxels of a box, two corners, or of that of the active ones.
py::array to_numpy(const GridObject& of, const py::object& bounds, const Call& call);

// For classes whose objects come from functions alone: Class.__new__() raises, too.
void refuse_empty(PyHeapTypeObject* type);

// (rows, columns) or (rows, columns, channels).
py::array array_of_image(Image&& image);

// The same back; the largest number of an unsigned type is 1, as in files. Throws std::invalid_argument that
// begins with `name` for other shapes, py::type_error for what holds no numbers.
Image image_of_array(py::handle object, const std::string& name);

// Grids, volumes, fields, and the functions that make and measure them: all of the below.
void add_volume(py::module_& module);
void add_grid(py::module_& module);
void add_makers(py::module_& module);
void add_measures(py::module_& module);
void add_pictures(py::module_& module);
void add_field(py::module_& module);

}  // namespace solidnoise::python
