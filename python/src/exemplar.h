#pragma once

#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "solidnoise/analysis/exemplar/exemplar.h"
#include "solidnoise/core/image.h"
#include "solidnoise/noise/gabor/gabor_spectrum.h"

namespace solidnoise::python {

namespace py = pybind11;

using ModelClass = py::class_<ExemplarModel>;

// A picture as callers have it: an array or a path. It is read without the interpreter's lock.
struct Picture {
  std::string name;
  std::optional<Image> image;  // none: the file of the name

  // What takes time is what comes after.
  Exemplar<2> read(const ExemplarReading& reading, Progress* progress) const {
    PartialProgress start(progress, 0.0, 0.0);
    return image ? exemplar_of_image(*image, reading, name) : read_exemplar(name, reading, &start);
  }
  bool has_linear_light() const { return !image && holds_linear_light(name); }
};

Picture picture_of_object(py::handle object, const std::string& name);

// The names of the groups of all channels.
std::vector<std::string> groups_of(const ExemplarModel& model);

// The models of noise by example, with their edits, and fit().
void add_model(py::module_& module);
void add_edits(ModelClass& of);
void add_exemplar(py::module_& module);

}  // namespace solidnoise::python
