#pragma once

#include <pybind11/pybind11.h>

namespace solidnoise::python {

// bake(), curvature() and surface_noise(), on meshes that are arrays.
void add_mesh(pybind11::module_& module);
void add_surface_noise(pybind11::module_& module);

}  // namespace solidnoise::python
