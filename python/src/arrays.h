#pragma once

#include <array>
#include <cstddef>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solidnoise/analysis/parallel_evaluation.h"
#include "solidnoise/core/field.h"
#include "solidnoise/core/vec.h"

namespace solidnoise::python {

namespace py = pybind11;

// Rows of numbers of an array of any layout, of float32 or float64, or of what becomes float64: vectors along
// the last axis, one for each place of the others. Nothing is copied; rows may be read without the
// interpreter's lock.
class Rows {
 public:
  // Throws py::type_error for what holds no numbers, std::invalid_argument that begins with `name` for
  // another length of the last axis.
  Rows(py::handle object, const std::string& name, py::ssize_t columns);

  std::size_t count() const { return count_; }
  // The array's shape without the last axis.
  const std::vector<py::ssize_t>& shape() const { return shape_; }
  double at(std::size_t row, int column) const;

  template <int Dim>
  Vec<Dim> vector(std::size_t row) const {
    Vec<Dim> result;
    for (int axis = 0; axis < Dim; ++axis) result[axis] = at(row, axis);
    return result;
  }

 private:
  const char* find(std::size_t row, int column) const;

  py::array array_;
  const char* data_ = nullptr;
  std::vector<py::ssize_t> shape_;
  std::vector<py::ssize_t> strides_;
  py::ssize_t column_stride_ = 0;
  bool is_single_ = false;
  std::size_t count_ = 1;
};

// The same of single numbers: an array of any shape, read in its order. Number: double or float.
template <typename Number = double>
std::vector<Number> numbers_of(py::handle object, const std::string& name);

extern template std::vector<double> numbers_of<double>(py::handle, const std::string&);
extern template std::vector<float> numbers_of<float>(py::handle, const std::string&);

// What NumPy makes of an object. Throws std::invalid_argument, by name, for lists that are no array.
py::array array_in(py::handle object, const std::string& name);

// A number for each axis, or one for all. Throws as Rows does.
std::vector<double> axes_of(py::handle object, const std::string& name, std::size_t axes);
template <int Dim>
Vec<Dim> vector_of(py::handle object, const std::string& name) {
  const std::vector<double> numbers = axes_of(object, name, Dim);
  Vec<Dim> result(0.0);
  for (int axis = 0; axis < Dim; ++axis) result[axis] = numbers[static_cast<std::size_t>(axis)];
  return result;
}

// Those of an array (n, 3). Throws as Rows does.
std::vector<Vec<3>> vectors_of(py::handle object, const std::string& name);

// Float32 values of `channels` numbers at each place of a shape, in memory of one channel after the other;
// the array has the channels as its last axis if there are several.
struct Values {
  py::object array;
  std::span<float> memory;
};
Values make_values(const std::vector<py::ssize_t>& shape, int channels);
// The same in an array of the caller's, which is to be like those that make_values() gives. Throws
// std::invalid_argument, py::type_error.
Values values_in(py::handle out, const std::vector<py::ssize_t>& shape, int channels);

// An array that owns a vector's memory.
template <typename Number>
py::array array_of(std::vector<Number>&& vector, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::vector<Number>(std::move(vector));
  const py::capsule owner(kept, [](void* memory) { delete static_cast<std::vector<Number>*>(memory); });
  return py::array_t<Number>(std::move(shape), kept->data(), owner);
}
template <typename Number>
py::array array_of(std::vector<Number>&& vector) {
  const auto size = static_cast<py::ssize_t>(vector.size());
  return array_of(std::move(vector), {size});
}

// (n, 3) of vectors.
py::array array_of(const std::vector<Vec<3>>& vectors);

}  // namespace solidnoise::python
