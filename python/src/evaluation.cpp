#include "evaluation.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "solidnoise/core/check.h"

namespace solidnoise::python {
namespace {

// Points of which so few take less time than a thread to begin.
constexpr std::size_t kFew = 256;

// Arrays for the samples of a field, in a shape.
template <int Dim>
struct SampleArrays {
  py::object result;
  Samples<Dim> samples;

  SampleArrays(const Field<Dim>& field, const std::vector<py::ssize_t>& shape, const Wanted& wanted) {
    const int channels = field.channels();
    const Values values =
        wanted.out.is_none() ? make_values(shape, channels) : values_in(wanted.out, shape, channels);
    samples.values = values.memory;
    result = values.array;
    if (!wanted.gradient) return;
    if (!field.has_gradient() || channels != 1)
      throw std::invalid_argument("gradient is True; this field has none");
    const Values gradient = make_values(shape, Dim);
    const std::size_t size = gradient.memory.size() / Dim;
    for (std::size_t axis = 0; axis < Dim; ++axis)
      samples.gradient[axis] = gradient.memory.subspan(axis * size, size);
    py::object vectors = gradient.array;
    if constexpr (Dim == 1) vectors = vectors.attr("__getitem__")(py::make_tuple(py::ellipsis(), py::none()));
    result = py::make_tuple(values.array, vectors);
  }
};

template <int Dim>
glm::vec<Dim, std::int64_t> integers_of(py::handle object, const std::string& name, double least,
                                        double most) {
  const Vec<Dim> numbers = vector_of<Dim>(object, name);
  glm::vec<Dim, std::int64_t> result(0);
  for (int axis = 0; axis < Dim; ++axis) {
    require_in_range(name, numbers[axis], least, most);
    if (numbers[axis] != std::floor(numbers[axis])) {
      throw std::invalid_argument(fmt::format("{} is {}; it must be whole numbers", name, numbers[axis]));
    }
    result[axis] = static_cast<std::int64_t>(numbers[axis]);
  }
  return result;
}

}  // namespace

template <int Dim>
py::object evaluate_points(const Field<Dim>& field, py::handle points, const Wanted& wanted,
                           const Call& call) {
  const Rows rows(points, "points", Dim);
  const SampleArrays<Dim> arrays(field, rows.shape(), wanted);
  const PointSource<Dim> source{rows.count(), [&](std::size_t first, std::span<Vec<Dim>> positions) {
                                  for (std::size_t i = 0; i < positions.size(); ++i) {
                                    positions[i] = rows.vector<Dim>(first + i);
                                  }
                                }};
  if (rows.count() <= kFew) {
    run_at_once([&] { evaluate_in_parallel(field, source, arrays.samples); });
    if (!call.progress.is_none()) call.progress(1.0);
  } else {
    run(call, [&](Progress& progress) { evaluate_in_parallel(field, source, arrays.samples, &progress); });
  }
  return arrays.result;
}

template <int Dim>
Lattice<Dim> lattice_of(const LatticePlace& place) {
  constexpr double kMost = std::numeric_limits<int>::max();
  Lattice<Dim> lattice;
  lattice.origin = vector_of<Dim>(place.origin, "origin");
  lattice.step = vector_of<Dim>(place.step, "step");
  lattice.count = integers_of<Dim>(place.shape, "shape", 1.0, kMost);
  lattice.first = integers_of<Dim>(place.first, "first", -0x1p53, 0x1p53);
  for (int axis = 0; axis < Dim; ++axis) {
    require_finite("origin", lattice.origin[axis]);
    require_positive("step", lattice.step[axis], "world units");
  }
  return lattice;
}

template <int Dim>
py::object evaluate_lattice(const Field<Dim>& field, const Lattice<Dim>& lattice, const Wanted& wanted,
                            const Call& call) {
  std::vector<py::ssize_t> shape(Dim);
  for (int axis = 0; axis < Dim; ++axis) shape[static_cast<std::size_t>(axis)] = lattice.count[axis];
  const SampleArrays<Dim> arrays(field, shape, wanted);
  run(call, [&](Progress& progress) { evaluate_in_parallel(field, lattice, arrays.samples, &progress); });
  return arrays.result;
}

template py::object evaluate_points(const Field<1>&, py::handle, const Wanted&, const Call&);
template py::object evaluate_points(const Field<2>&, py::handle, const Wanted&, const Call&);
template py::object evaluate_points(const Field<3>&, py::handle, const Wanted&, const Call&);
template py::object evaluate_points(const Field<4>&, py::handle, const Wanted&, const Call&);
template Lattice<1> lattice_of(const LatticePlace&);
template Lattice<2> lattice_of(const LatticePlace&);
template Lattice<3> lattice_of(const LatticePlace&);
template Lattice<4> lattice_of(const LatticePlace&);
template py::object evaluate_lattice(const Field<1>&, const Lattice<1>&, const Wanted&, const Call&);
template py::object evaluate_lattice(const Field<2>&, const Lattice<2>&, const Wanted&, const Call&);
template py::object evaluate_lattice(const Field<3>&, const Lattice<3>&, const Wanted&, const Call&);
template py::object evaluate_lattice(const Field<4>&, const Lattice<4>&, const Wanted&, const Call&);

}  // namespace solidnoise::python
