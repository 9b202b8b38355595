#include "arrays.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace solidnoise::python {
namespace {

// As it is if it holds floats; other numbers become float64.
py::array as_floats(py::handle object, const std::string& name) {
  if (py::isinstance<py::array_t<double>>(object) || py::isinstance<py::array_t<float>>(object)) {
    return py::reinterpret_borrow<py::array>(object);
  }
  const py::array array = array_in(object, name);
  if (std::string("biuf").find(array.dtype().kind()) == std::string::npos) {
    throw py::type_error(name + " must be numbers");
  }
  return py::array_t<double, py::array::forcecast>::ensure(array);
}

template <typename Number>
double read(const char* place) {
  Number number;
  std::memcpy(&number, place, sizeof number);  // which may be anywhere
  return static_cast<double>(number);
}

// With the channels first, as memory has them.
std::vector<py::ssize_t> memory_shape(const std::vector<py::ssize_t>& shape, int channels) {
  std::vector<py::ssize_t> result = shape;
  if (channels > 1) result.insert(result.begin(), channels);
  return result;
}

py::object channels_last(const py::array& array, int channels) {
  if (channels == 1) return array;
  return py::module_::import("numpy").attr("moveaxis")(array, 0, -1);
}

std::string text_of(const std::vector<py::ssize_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

}  // namespace

Rows::Rows(py::handle object, const std::string& name, py::ssize_t columns)
    : array_(as_floats(object, name)) {
  if (array_.ndim() == 0 || array_.shape(array_.ndim() - 1) != columns) {
    const std::vector<py::ssize_t> found(array_.shape(), array_.shape() + array_.ndim());
    throw std::invalid_argument(
        fmt::format("{} has the shape {}; it must be (..., {})", name, text_of(found), columns));
  }
  data_ = static_cast<const char*>(array_.data());
  is_single_ = py::isinstance<py::array_t<float>>(array_);
  for (py::ssize_t axis = 0; axis + 1 < array_.ndim(); ++axis) {
    shape_.push_back(array_.shape(axis));
    strides_.push_back(array_.strides(axis));
    count_ *= static_cast<std::size_t>(array_.shape(axis));
  }
  column_stride_ = array_.strides(array_.ndim() - 1);
}

double Rows::at(std::size_t row, int column) const {
  const char* const place = find(row, column);
  return is_single_ ? read<float>(place) : read<double>(place);
}

const char* Rows::find(std::size_t row, int column) const {
  const char* place = data_ + column * column_stride_;
  for (std::size_t axis = shape_.size(); axis-- > 0;) {
    const auto size = static_cast<std::size_t>(shape_[axis]);
    place += static_cast<py::ssize_t>(row % size) * strides_[axis];
    row /= size;
  }
  return place;
}

py::array array_in(py::handle object, const std::string& name) {
  const py::array array = py::array::ensure(object);
  if (!array)
    throw std::invalid_argument(name + " must be an array, or lists that are as long as each other");
  return array;
}

std::vector<double> axes_of(py::handle object, const std::string& name, std::size_t axes) {
  std::vector<double> numbers = numbers_of(object, name);
  if (numbers.size() == 1) numbers.resize(axes, numbers.front());
  if (numbers.size() != axes) {
    throw std::invalid_argument(
        fmt::format("{} has {} numbers; it must have {}, or one for all axes", name, numbers.size(), axes));
  }
  return numbers;
}

template <typename Number>
std::vector<Number> numbers_of(py::handle object, const std::string& name) {
  const py::array array = as_floats(object, name);
  const auto dense = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(array);
  return {dense.data(), dense.data() + dense.size()};
}

template std::vector<double> numbers_of<double>(py::handle, const std::string&);
template std::vector<float> numbers_of<float>(py::handle, const std::string&);

std::vector<Vec<3>> vectors_of(py::handle object, const std::string& name) {
  const Rows rows(object, name, 3);
  std::vector<Vec<3>> vectors;
  vectors.reserve(rows.count());
  for (std::size_t i = 0; i < rows.count(); ++i) vectors.push_back(rows.vector<3>(i));
  return vectors;
}

Values make_values(const std::vector<py::ssize_t>& shape, int channels) {
  py::array_t<float> array(memory_shape(shape, channels));
  const std::span memory(array.mutable_data(), static_cast<std::size_t>(array.size()));
  return {channels_last(array, channels), memory};
}

Values values_in(py::handle out, const std::vector<py::ssize_t>& shape, int channels) {
  if (!py::isinstance<py::array_t<float>>(out)) throw py::type_error("out must be an array of float32");
  py::array array = py::reinterpret_borrow<py::array>(out);
  if (channels > 1 && array.ndim() > 0) {
    array = py::module_::import("numpy").attr("moveaxis")(array, -1, 0);
  }
  const std::vector<py::ssize_t> wanted = memory_shape(shape, channels);
  const std::vector<py::ssize_t> found(array.shape(), array.shape() + array.ndim());
  if (found != wanted) {
    const auto as_given = [&](std::vector<py::ssize_t> memory) {
      if (channels > 1 && !memory.empty()) std::rotate(memory.begin(), memory.begin() + 1, memory.end());
      return text_of(memory);
    };
    throw std::invalid_argument(
        fmt::format("out has the shape {}; it must be {}", as_given(found), as_given(wanted)));
  }
  if ((array.flags() & py::array::c_style) == 0) {
    throw std::invalid_argument(channels > 1 ? "out must have its channels one after the other in memory, as "
                                               "numpy.moveaxis(numpy.empty((channels, ...)), 0, -1) has them"
                                             : "out must be contiguous, its last axis the fastest");
  }
  if (!array.writeable()) throw std::invalid_argument("out cannot be written to");
  auto* const memory = static_cast<float*>(array.mutable_data());
  return {py::reinterpret_borrow<py::object>(out), {memory, static_cast<std::size_t>(array.size())}};
}

py::array array_of(const std::vector<Vec<3>>& vectors) {
  static_assert(sizeof(Vec<3>) == 3 * sizeof(double));
  const py::array_t<double> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  if (!vectors.empty())
    std::memcpy(const_cast<double*>(array.data()), vectors.data(), vectors.size() * sizeof(Vec<3>));
  return array;
}

}  // namespace solidnoise::python
