#include <algorithm>
#include <array>
#include <cstdint>
#include <pybind11/stl.h>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <openvdb/tools/Dense.h>

#include "call.h"
#include "solidnoise/volume/vdb/grid_values.h"
#include "volume.h"

namespace solidnoise::python {

namespace {

py::tuple tuple_of(const openvdb::Coord& c) {
  return py::make_tuple(c.x(), c.y(), c.z());
}
py::tuple tuple_of(const openvdb::Vec3d& v) {
  return py::make_tuple(v.x(), v.y(), v.z());
}

// Copies the voxels of a box, active or not, in parallel.
template <typename Grid, typename Number>
void copy_dense(const Grid& grid, const openvdb::CoordBBox& box, Number* memory, Progress& progress) {
  using Value = typename Grid::ValueType;
  static_assert(sizeof(Value) % sizeof(Number) == 0);
  constexpr int kThick = 64;  // voxels along x, the slowest axis, that are copied at once
  const auto layer = static_cast<std::size_t>(box.dim().y()) * static_cast<std::size_t>(box.dim().z());
  auto* values = reinterpret_cast<Value*>(memory);
  for (int offset = 0; offset < box.dim().x(); offset += kThick) {
    throw_if_cancelled(&progress);
    openvdb::CoordBBox slab = box;
    slab.min().x() += offset;
    slab.max().x() = std::min(slab.min().x() + kThick - 1, box.max().x());
    openvdb::tools::Dense<Value, openvdb::tools::LayoutZYX> dense(slab, values);
    openvdb::tools::copyToDense(grid, dense);
    values += static_cast<std::size_t>(slab.dim().x()) * layer;
    progress.advance(static_cast<std::uint64_t>(offset + slab.dim().x()),
                     static_cast<std::uint64_t>(box.dim().x()));
  }
}

constexpr std::int64_t kMostVoxels = 1 << 20;  // along an axis

openvdb::CoordBBox box_of(const py::object& bounds) {
  try {
    const auto corners = bounds.cast<std::pair<std::array<int, 3>, std::array<int, 3>>>();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t voxels = std::int64_t{corners.second[axis]} - corners.first[axis] + 1;
      if (voxels > kMostVoxels)
        throw std::invalid_argument(
            fmt::format("bounds are of {} voxels along an axis; it must be {} at most", voxels, kMostVoxels));
    }
    return {openvdb::Coord(corners.first.data()), openvdb::Coord(corners.second.data())};
  } catch (const py::cast_error&) {
    throw py::type_error("bounds must be two tuples of 3 ints, the first and the last voxel");
  }
}

py::object bounds_of(const GridObject& of) {
  const openvdb::CoordBBox box = of.grid->evalActiveVoxelBoundingBox();
  if (box.empty()) return py::none();
  return py::make_tuple(tuple_of(box.min()), tuple_of(box.max()));
}

py::object origin_of(const GridObject& of) {
  const openvdb::CoordBBox box = of.grid->evalActiveVoxelBoundingBox();
  if (box.empty()) return py::none();
  return tuple_of(of.grid->indexToWorld(box.min()));
}

py::dict metadata_of(const openvdb::MetaMap& of) {
  py::dict result;
  for (auto item = of.beginMeta(); item != of.endMeta(); ++item) {
    const std::string& name = item->first;
    const auto number = [&]<typename Number>(std::type_identity<Number>) {
      const auto typed = of.getMetadata<openvdb::TypedMetadata<Number>>(name);
      if (typed) result[py::str(name)] = py::cast(typed->value());
      return typed != nullptr;
    };
    if (number(std::type_identity<std::string>()) || number(std::type_identity<std::int64_t>()) ||
        number(std::type_identity<std::int32_t>()) || number(std::type_identity<double>()) ||
        number(std::type_identity<float>()) || number(std::type_identity<bool>())) {
      continue;
    }
    result[py::str(name)] = item->second->str();
  }
  return result;
}

std::string represent(const GridObject& of) {
  return fmt::format("<solidnoise.Grid {}, {} of {}, {} active voxels>", of.grid->getName(),
                     openvdb::GridBase::gridClassToString(of.grid->getGridClass()), of.grid->valueType(),
                     of.grid->activeVoxelCount());
}

}  // namespace

void refuse_empty(PyHeapTypeObject* type) {
  type->ht_type.tp_new = [](PyTypeObject* of, PyObject*, PyObject*) -> PyObject* {
    return PyErr_Format(PyExc_TypeError, "%s cannot be made by itself; make_volume() and read_volume() do",
                        of->tp_name);
  };
}

py::array to_numpy(const GridObject& of, const py::object& bounds, const Call& call) {
  openvdb::CoordBBox box = of.grid->evalActiveVoxelBoundingBox();
  if (!bounds.is_none()) box = box_of(bounds);
  const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(of.grid);
  const auto vectors = in_single_precision(*of.grid);
  if (!floats && !vectors) {
    throw std::invalid_argument(fmt::format("grid {} is of {}; it must be of float or vectors",
                                            of.grid->getName(), of.grid->valueType()));
  }
  const bool empty = box.empty();
  std::vector<py::ssize_t> shape(3, 0);
  for (std::size_t axis = 0; !empty && axis < 3; ++axis) shape[axis] = box.dim()[static_cast<int>(axis)];
  if (vectors) shape.push_back(3);
  py::array_t<float> array(shape);
  if (empty) return array;
  float* const memory = array.mutable_data();
  run(call, [&](Progress& told) {
    if (floats) return copy_dense(*floats, box, memory, told);
    copy_dense(*vectors, box, memory, told);
  });
  return array;
}

void add_grid(py::module_& module) {
  using namespace py::literals;
  py::class_<GridObject> of(module, "Grid", py::custom_type_setup(&refuse_empty),
                            "A grid of a volume. What it holds belongs to the volume; to_numpy() copies it.");
  const auto property = [&](const char* name, auto get, const char* text) {
    of.def_property_readonly(name, get, text);
  };
  property(
      "name", [](const GridObject& g) { return g.grid->getName(); }, "Its name, such as density.");
  property(
      "value_type", [](const GridObject& g) { return g.grid->valueType(); }, "OpenVDB's: float, vec3s, ...");
  property(
      "grid_class",
      [](const GridObject& g) { return openvdb::GridBase::gridClassToString(g.grid->getGridClass()); },
      "OpenVDB's: fog volume, level set, unknown, ...");
  property(
      "voxel_size", [](const GridObject& g) { return tuple_of(g.grid->voxelSize()); },
      "World units along x, y, z.");
  property(
      "active_voxels", [](const GridObject& g) { return g.grid->activeVoxelCount(); },
      "How many voxels are active.");
  property("bounds", &bounds_of,
           "The first and the last voxel, as indices, of the box of active voxels; None if there are none.");
  property("origin", &origin_of,
           "Where the centre of the first of these is, world units: that of to_numpy()[0, 0, 0].");
  property(
      "metadata", [](const GridObject& g) { return metadata_of(*g.grid); },
      "What the file says of it, as a new dict.");
  of.def(
      "to_numpy",
      [](const GridObject& g, const py::object& bounds, std::optional<int> threads, py::object progress) {
        return to_numpy(g, bounds, {threads, std::move(progress)});
      },
      "bounds"_a = py::none(), py::kw_only(), "threads"_a = py::none(), "progress"_a = py::none(),
      R"(to_numpy(self, bounds=None, *, threads=None, progress=None)
--

The values of a box of voxels, active or not, as a new array of float32: (x, y, z), or (x, y, z, 3) of vectors.

bounds : two tuples of 3 ints
    The first and the last voxel; left out, the box of active voxels.
threads, progress
    As of Noise.)");
  of.def("__repr__", [](const GridObject& g) { return represent(g); });
}

}  // namespace solidnoise::python
