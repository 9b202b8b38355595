#include <optional>
#include <pybind11/stl.h>
#include <stdexcept>
#include <utility>

#include "evaluation.h"
#include "noise.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"

namespace solidnoise::python {
namespace {

py::object evaluate(const NoiseObject& noise, py::handle points, bool gradient, py::object out,
                    std::optional<int> threads, py::object progress) {
  const Call call(threads, std::move(progress));
  return noise.visit([&]<typename Pointer>(const Pointer& field) {
    return evaluate_points<kDimOf<Pointer>>(*field, points, {std::move(out), gradient}, call);
  });
}

template <int Dim>
py::object evaluate_on_lattice(const std::shared_ptr<const Noise<Dim>>& noise, const Lattice<Dim>& lattice,
                               double error, const Wanted& wanted, const Call& call) {
  if (error == 0.0) return evaluate_lattice<Dim>(*noise, lattice, wanted, call);
  if constexpr (Dim == 2 || Dim == 3) {
    std::shared_ptr<const Noise<Dim>> quick;
    run_at_once([&] { quick = interpolate<Dim>(noise, {lattice.origin, lattice.step}, error); });
    return evaluate_lattice<Dim>(*quick, lattice, wanted, call);
  } else {
    throw std::invalid_argument("interpolate is True; it needs a noise of 2 or 3 dimensions");
  }
}

py::object evaluate_lattice_of(const NoiseObject& noise, const LatticePlace& place, const Wanted& wanted,
                               bool interpolated, const Call& call) {
  const double error = interpolated ? ErrorBudget(error_of(noise.recipe())).interpolation : 0.0;
  return noise.visit([&]<typename Pointer>(const Pointer& field) {
    return evaluate_on_lattice<kDimOf<Pointer>>(field, lattice_of<kDimOf<Pointer>>(place), error, wanted,
                                                call);
  });
}

}  // namespace

void add_evaluation(NoiseClass& of) {
  using namespace py::literals;
  of.def("__call__", &evaluate, "points"_a, py::kw_only(), "gradient"_a = false, "out"_a = py::none(),
         "threads"_a = py::none(), "progress"_a = py::none(),
         R"(__call__(self, points, *, gradient=False, out=None, threads=None, progress=None)
--

The noise at points, one value each.

points : array (..., dims), world units
    Of any layout, float64 or float32; positions are taken in double precision. Between -1e9 and 1e9.
gradient : bool
    Whether the derivative along each axis, per world unit, is wanted too.
out : array of float32, contiguous, of the shape of the values
    Where values go, instead of an array of their own.
threads : int, 1 to 4096
    At most so many; left out, all.
progress : function
    Called with the fraction that is done: 0 before the work begins, then some 20 times a second.

Returns an array (...) of float32, or with the gradient a tuple of it and an array (..., dims). A value depends on the noise and
on the point alone: not on the other points, nor on threads. Ctrl-C stops the call.

Raises ValueError for points of another shape, or that are not finite.)");
  of.def(
      "lattice",
      [](const NoiseObject& noise, py::object origin, py::object step, py::object shape, py::object out,
         bool gradient, py::object first, bool interpolated, std::optional<int> threads,
         py::object progress) {
        return evaluate_lattice_of(noise,
                                   {std::move(origin), std::move(step), std::move(shape), std::move(first)},
                                   {std::move(out), gradient}, interpolated, {threads, std::move(progress)});
      },
      "origin"_a, "step"_a, "shape"_a, "out"_a = py::none(), "gradient"_a = false, py::kw_only(),
      "first"_a = 0, "interpolate"_a = false, "threads"_a = py::none(), "progress"_a = py::none(),
      R"(lattice(self, origin, step, shape, out=None, gradient=False, *, first=0, interpolate=False, threads=None, progress=None)
--

The noise on a regular lattice: far quicker than at as many points.

origin : dims floats, or one for all axes, world units
    Where sample 0 is.
step : dims floats or one, above 0, world units
    Between samples.
shape : dims ints or one
    Samples along each axis: of 3 dimensions (x, y, z). The array that is returned is indexed in this order, as voxels of
    OpenVDB are: values[i, j, k] is at origin + step * (i, j, k), and the last axis is the fastest in memory.
out, gradient, threads, progress
    As for points; the derivatives are an array (x, y, z, dims).
first : dims ints or one
    The index of the first sample: parts of one lattice, of one origin and step, agree to the last bit.
interpolate : bool
    Whether waves that the lattice resolves well may be interpolated from fewer samples, with about the noise's `error` more, as
    volumes do: several times quicker. Values then depend on origin and step, too.

Returns an array of float32 of the shape, C-contiguous, or with the gradient a tuple of it and of the derivatives.)");
}

}  // namespace solidnoise::python
