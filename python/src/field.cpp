#include <functional>
#include <optional>
#include <pybind11/stl.h>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "call.h"
#include "evaluation.h"
#include "json.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/volume/recipe_field.h"
#include "solidnoise/volume/volume_recipe_json.h"
#include "volume.h"

namespace solidnoise::python {
namespace {

// Shapes, and their soft edges, are of voxels, and so are grids that are modified.
void require_no_voxels(const VolumeRecipe& recipe) {
  if (recipe.modification) {
    throw std::invalid_argument("a field has no voxels; it does not go with a grid that exists (on)");
  }
  if (!std::holds_alternative<BoxShape>(recipe.shape)) {
    const Json domain = to_json(recipe)["domain"];
    throw std::invalid_argument(fmt::format("shape is {}; a field has no voxels: it must be box",
                                            domain["shape"]["type"].get<std::string>()));
  }
  const auto require_hard = [](const char* name, const std::optional<double>& edge) {
    if (edge.value_or(0.0) == 0.0) return;
    throw std::invalid_argument(
        fmt::format("{} is {}; a field has no voxels: it must be left out, or 0", name, *edge));
  };
  require_hard("edge", recipe.edge);
  require_hard("edge_voxels", recipe.edge_voxels);
}

// What a grid of a recipe is filled with, as callers hold it. Immutable.
class FieldObject {
 public:
  // Reads the files that the recipe names. Throws as RecipeField.
  FieldObject(const VolumeRecipe& recipe, const std::optional<std::string>& grid, const Call& call)
      : recipe_(recipe), grid_(grid) {
    require_no_voxels(recipe);
    run(call, [&](Progress& told) {
      field_.emplace(recipe, grid.value_or(""), &told);
      own_ = field_->on_voxels(field_->frame()).field;
    });
  }

  const VolumeRecipe& recipe() const { return recipe_; }
  const std::optional<std::string>& grid() const { return grid_; }
  const VolumeRecipe& single() const { return field_->single(); }
  int channels() const { return own_->channels(); }

  const Field<3>& at_points() const {
    if (single().band_limit) throw std::invalid_argument("band_limit needs the size of the voxels");
    return *own_;
  }

  // As it is on the voxels of a lattice, whatever part of it.
  FieldPtr on_lattice(const Lattice<3>& lattice, bool interpolated) const {
    const openvdb::Vec3d step(lattice.step.x, lattice.step.y, lattice.step.z);
    const openvdb::Vec3d origin(lattice.origin.x, lattice.origin.y, lattice.origin.z);
    const GridFrame frame(openvdb::math::Transform(
        openvdb::math::MapBase::Ptr(std::make_shared<openvdb::math::ScaleTranslateMap>(step, origin))));
    return field_->on_voxels(frame, interpolated).field;
  }

  bool operator==(const FieldObject& other) const {
    return grid_ == other.grid_ && to_json(recipe_) == to_json(other.recipe_);
  }

 private:
  VolumeRecipe recipe_;
  std::optional<std::string> grid_;
  std::optional<RecipeField> field_;
  FieldPtr own_;  // as on the recipe's own voxels
};

using FieldClass = py::class_<FieldObject>;

std::string represent(const FieldObject& field) {
  std::set<std::string> kinds;
  for (const NoiseRecipe& noise : noises_of(field.single())) kinds.emplace(noise_type(noise));
  return fmt::format("<solidnoise.Field {}, {} channel{}, of {}>",
                     fmt::join(grid_names(field.single()), ", "), field.channels(),
                     field.channels() == 1 ? "" : "s", fmt::join(kinds, ", "));
}

void add_values(FieldClass& of) {
  using namespace py::literals;
  of.def(
      "__call__",
      [](const FieldObject& field, py::handle points, bool gradient, py::object out,
         std::optional<int> threads, py::object progress) {
        return evaluate_points<3>(field.at_points(), points, {std::move(out), gradient},
                                  {threads, std::move(progress)});
      },
      "points"_a, py::kw_only(), "gradient"_a = false, "out"_a = py::none(), "threads"_a = py::none(),
      "progress"_a = py::none(),
      R"(__call__(self, points, *, gradient=False, out=None, threads=None, progress=None)
--

The field at points.

points : array (..., 3), world units
gradient, out, threads, progress
    As of Noise; fields whose parts all have a gradient have one.

Returns an array (...) of float32, or (..., channels) where there are several. Ctrl-C stops the call.

Raises ValueError for points of another shape, or that are not finite; and where the recipe has band_limit, which needs voxels.)");
  of.def(
      "lattice",
      [](const FieldObject& field, py::object origin, py::object step, py::object shape, py::object out,
         bool gradient, py::object first, bool interpolated, std::optional<int> threads,
         py::object progress) {
        const Call call(threads, std::move(progress));
        const auto lattice =
            lattice_of<3>({std::move(origin), std::move(step), std::move(shape), std::move(first)});
        FieldPtr made;
        run_at_once([&] { made = field.on_lattice(lattice, interpolated); });
        return evaluate_lattice<3>(*made, lattice, {std::move(out), gradient}, call);
      },
      "origin"_a, "step"_a, "shape"_a, "out"_a = py::none(), "gradient"_a = false, py::kw_only(),
      "first"_a = 0, "interpolate"_a = false, "threads"_a = py::none(), "progress"_a = py::none(),
      R"(lattice(self, origin, step, shape, out=None, gradient=False, *, first=0, interpolate=False, threads=None, progress=None)
--

The field on a regular lattice, as if its samples were voxels: see Noise.lattice(). With the origin of voxel (0, 0, 0), which is 0 in
volumes that are made, the voxels' size for step, and interpolate=True unless the recipe is exact, values are those that make_volume()
fills voxels with, to the last bit.

Returns an array (x, y, z) of float32, or (x, y, z, channels), C-contiguous but for its channels; with the gradient a tuple of it and an
array (x, y, z, 3).)");
}

void add_state(FieldClass& of) {
  using namespace py::literals;
  of.def_property_readonly(
      "channels", &FieldObject::channels,
      "Numbers at a place: 1, 3 of a velocity, a colour or a gradient, more of several outputs.");
  of.def_property_readonly(
      "grids", [](const FieldObject& field) { return grid_names(field.single()); },
      "The names of the grids that volumes have of the field; of several, the channels follow each other.");
  of.def_property_readonly("grid", &FieldObject::grid,
                           "The name by which it was chosen; None if none was given.");
  of.def_property_readonly(
      "recipe", [](const FieldObject& field) { return object_of(to_json(field.recipe())); },
      "The whole recipe, as a new dict: what make_volume() takes.");
  of.def("__repr__", [](const FieldObject& field) { return represent(field); });
  of.def("__eq__", [](const FieldObject& field, py::object other) -> py::object {
    if (!py::isinstance<FieldObject>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(field == other.cast<const FieldObject&>());
  });
  of.def("__hash__", [](const FieldObject& field) {
    return std::hash<std::string>()(hashed_text(to_json(field.recipe())) + field.grid().value_or(""));
  });
  of.def("__reduce__", [](const py::object& self) {  // by the constructor, in pickles of any protocol
    const auto& field = self.cast<const FieldObject&>();
    const py::object partial = py::module_::import("functools").attr("partial");
    return py::make_tuple(partial(py::type::of(self), "grid"_a = field.grid()),
                          py::make_tuple(object_of(to_json(field.recipe()))));
  });
}

}  // namespace

void add_field(py::module_& module) {
  using namespace py::literals;
  FieldClass of(module, "Field",
                R"(Field(recipe=None, /, *, grid=None, **keys)
--

What a volume's voxels are filled with, anywhere: noise, layers, folds, warps, maps, clouds, velocities, colours.

recipe : as of make_volume(), or a Volume
grid : str
    Of several grids, the one of this name; left out, the first one.
keys
    Of the recipe, as of make_volume(): take the place of its own, or are merged into them.

    ridges = solidnoise.Field(noise={"type": "gabor", "frequency": 3}, layers=[{"fold": "ridged"}])
    ridges([[0.0, 0.5, 1.0], [2.0, 0.0, 0.0]])                # at points
    ridges.lattice(origin=0, step=0.02, shape=(64, 64, 64))   # on a lattice

There are no voxels: densities are from 0 to 1, before they are scaled to an optical depth or a peak and pruned. The recipe's box is where
clouds stay and places are measured; noise goes on beyond it. Fields are immutable, may be compared, copied and pickled, and used by several
threads at once.

Raises ValueError for a recipe that is not allowed, or that needs voxels (a shape other than the box, an edge, a grid to work on), OSError
for files that it names.)");
  of.def(py::init([](py::handle recipe, const std::optional<std::string>& grid, const py::kwargs& keys) {
           return FieldObject(volume_recipe_of(recipe, keys), grid, {std::nullopt, py::none()});
         }),
         "recipe"_a = py::none(), py::pos_only(), py::kw_only(), "grid"_a = py::none());
  add_values(of);
  add_state(of);
}

}  // namespace solidnoise::python
