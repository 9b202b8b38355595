#pragma once

#include <pybind11/pybind11.h>

namespace solidnoise::python {

// fit(), and the models of noise by example with their edits.
void add_exemplar(pybind11::module_& module);

}  // namespace solidnoise::python
