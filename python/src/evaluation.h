#pragma once

#include <memory>
#include <pybind11/pybind11.h>

#include "arrays.h"
#include "call.h"
#include "solidnoise/core/field.h"

namespace solidnoise::python {

// What a field's call and its lattice() take, as callers give it.
struct LatticePlace {
  py::object origin;
  py::object step;
  py::object shape;
  py::object first;
};
struct Wanted {
  py::object out;  // an array to write to, or None
  bool gradient = false;
};

// The values of a field at points, an array (..., Dim), in the points' shape; with the gradient a tuple of
// both. Components of vectors and of gradients are the last axis.
template <int Dim>
py::object evaluate_points(const Field<Dim>& field, py::handle points, const Wanted& wanted,
                           const Call& call);

// The same on a lattice; `shape` has the samples along each axis.
template <int Dim>
Lattice<Dim> lattice_of(const LatticePlace& place);
template <int Dim>
py::object evaluate_lattice(const Field<Dim>& field, const Lattice<Dim>& lattice, const Wanted& wanted,
                            const Call& call);

}  // namespace solidnoise::python
