#pragma once

#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

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

// Grids, volumes, and the functions that make and measure them.
void add_volume(py::module_& module);

}  // namespace solidnoise::python
