#include "noise.h"

#include <functional>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "documentation.h"
#include "json.h"
#include "solidnoise/core/check.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/noise_recipe_json.h"

namespace solidnoise::python {
namespace {

template <int Dim>
std::shared_ptr<const Noise<Dim>> make(const NoiseRecipe& recipe, std::optional<double> time) {
  return make_noise<Dim>(time ? at_time(recipe, *time) : recipe);
}

// A vector of four axes may be given with fewer: the others are 0.
void fill_axes(Json& json) {
  constexpr std::size_t kAxes = 4;
  for (const char* const key : {"period", "direction"}) {
    if (!json.contains(key) || !json[key].is_array()) continue;
    while (!json[key].empty() && json[key].size() < kAxes) json[key].push_back(0.0);
  }
}

// A whole file of noisefit's, with further keys or without, is a noise by example.
void unwrap_exemplar(Json& json) {
  if (!json.contains("exemplar") || !json.contains("solidnoise")) return;
  Json file = Json::object();
  for (const char* const key : {"solidnoise", "algorithm", "$schema", "pixel_size", "exemplar"}) {
    if (!json.contains(key)) continue;
    file[key] = json[key];
    json.erase(key);
  }
  json["exemplar"] = to_json(exemplar_file_from_json(file));
  json["type"] = "spectrum";
}

NoiseObject noise_of_json(Json json, int dims, std::optional<double> time) {
  unwrap_exemplar(json);
  fill_axes(json);
  JsonReader reader(json);
  return {noise_recipe_from_json(reader), dims, time};
}

// Without dims and time they are those of a noise that is changed.
NoiseObject make_object(py::handle recipe, std::optional<int> given_dims, std::optional<double> time,
                        const py::kwargs& options) {
  constexpr int kDims = 3;
  std::optional<NoiseObject> made;
  const NoiseObject* const from =
      py::isinstance<NoiseObject>(recipe) ? &recipe.cast<const NoiseObject&>() : nullptr;
  const int dims = given_dims.value_or(from ? from->made_dims() : kDims);
  if (from && !time) time = from->time();
  use_recipe(recipe, options, [&](const Json& json) { made.emplace(noise_of_json(json, dims, time)); });
  return std::move(*made);
}

// What of a recipe differs from what it is by default.
Json changes_of(const NoiseRecipe& recipe) {
  const Json json = to_json(recipe);
  const Json standard = to_json(default_noise(noise_type(recipe)));
  Json changes = Json::object();
  for (const auto& [key, value] : json.items()) {
    if (key != "type" && (!standard.contains(key) || standard[key] != value)) changes[key] = value;
  }
  return changes;
}

std::string function_of(std::string_view type) {
  std::string name(type);
  for (char& c : name) {
    if (c == '-') c = '_';
  }
  return name;
}

std::string represent(const NoiseObject& noise) {
  std::string text =
      fmt::format("solidnoise.{}(dims={}", function_of(noise_type(noise.recipe())), noise.made_dims());
  if (noise.time()) text += ", time=" + std::string(py::repr(py::float_(*noise.time())));
  const Json changes = changes_of(noise.recipe());
  for (const auto& [key, value] : changes.items()) {
    const std::string shown = value.is_object() ? "{...}" : std::string(py::repr(object_of(value)));
    text += fmt::format(", {}={}", key, shown);
  }
  return text + ")";
}

void add_state(NoiseClass& of) {
  using namespace py::literals;
  of.def_property_readonly(
      "recipe", [](const NoiseObject& noise) { return object_of(to_json(noise.recipe())); },
      "What the noise is made of, as a new dict: what recipes of volumes have under \"noise\".");
  of.def_property_readonly("dims", &NoiseObject::dims, "Dimensions of its positions, 1 to 4.");
  of.def_property_readonly("time", &NoiseObject::time,
                           "The time that it is looked at; None if none was given.");
  of.def(
      "at_time",
      [](const NoiseObject& noise, double time) {
        return NoiseObject(noise.recipe(), noise.made_dims(), time);
      },
      "time"_a, py::pos_only(),
      R"(at_time(self, time, /)
--

The noise at a time: of one that evolves (evolve=...) a moment, of one of 4 dimensions a slice, of 3. Raises ValueError for noises that
do neither.)");
  of.def("__repr__", [](const NoiseObject& noise) { return represent(noise); });
  of.def("__eq__", [](const NoiseObject& noise, py::object other) -> py::object {
    if (!py::isinstance<NoiseObject>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(noise == other.cast<const NoiseObject&>());
  });
  of.def("__hash__", [](const NoiseObject& noise) {
    return std::hash<std::string>()(hashed_text(to_json(noise.recipe())));
  });
  of.def("__reduce__", [](const py::object& self) {  // by the constructor, in pickles of any protocol
    const auto& noise = self.cast<const NoiseObject&>();
    const py::object partial = py::module_::import("functools").attr("partial");
    return py::make_tuple(partial(py::type::of(self), "dims"_a = noise.made_dims(), "time"_a = noise.time()),
                          py::make_tuple(object_of(to_json(noise.recipe()))));
  });
}

// A function for each kind of noise, whose keywords are its options.
template <typename Options>
void add_kind(py::module_& module, const Json& schema) {
  using namespace py::literals;
  using Entry = NoiseEntry<Options>;
  const std::string type(Entry::kName);
  const std::string name = function_of(type);
  const std::string signature = fmt::format("{}(*, dims=3, time=None{})", name, signature_of_options(schema));
  const std::string text = fmt::format(
      "{}, of {} to {} dimensions.\n\ndims : int\n    Dimensions of its positions.\ntime : float\n    Of a "
      "noise that changes "
      "with time: when it is looked at; see at_time().\n{}\nReturns a Noise. Raises ValueError for options "
      "that are not allowed.",
      Entry::kHelp, Entry::kLeastDimensions, Entry::kMostDimensions, describe_options(schema));
  module.def(
      name.c_str(),
      [type](int dims, std::optional<double> time, const py::kwargs& options) {
        py::dict recipe("type"_a = type);
        return make_object(recipe, dims, time, options);
      },
      py::kw_only(), "dims"_a = 3, "time"_a = py::none(), document(signature, text).c_str());
}

}  // namespace

NoiseObject::NoiseObject(NoiseRecipe recipe, int dims, std::optional<double> time)
    : recipe_(std::move(recipe)), made_dims_(dims), time_(time) {
  require_in_range("dims", dims, 1, 4);
  if (time) require_finite("time", *time);
  if (time && dims != 4 && !evolves(recipe_)) {
    throw std::invalid_argument(fmt::format(
        "time is {}; it needs a noise that changes with time: of 4 dimensions, or with evolve above 0",
        *time));
  }
  if (dims == 4 && evolves(recipe_))
    throw std::invalid_argument("dims is 4; it must be 1 to 3 where the noise evolves");
  if (dims == 1) noise_ = make<1>(recipe_, time);
  if (dims == 2) noise_ = make<2>(recipe_, time);
  if (dims == 3) noise_ = make<3>(recipe_, time);
  if (dims != 4) return;
  if (time) {
    noise_ = NoisePtr<3>(slice(make<4>(recipe_, std::nullopt), *time));
  } else {
    noise_ = make<4>(recipe_, std::nullopt);
  }
}

void add_noise(py::module_& module) {
  using namespace py::literals;
  NoiseClass of(module, "Noise",
                R"(Noise(recipe=None, /, *, dims=None, time=None, **options)
--

A random field with a known spectrum: of mean 0 and, unless it is filtered, variance 1.

recipe : dict, Noise, or the path of a .json file
    The options by name, with "type" for the kind: what recipes of volumes have under "noise". A file may also be a noise by example,
    as noisefit writes it.
dims : int, 1 to 4
    Dimensions of its positions: 3, or those of a Noise.
time : float
    Of a noise that changes with time: when it is looked at, see at_time(), or that of a Noise.
options
    Take the place of those of the recipe. gabor(), gabor_oriented(), kensler(), cellular() and spectrum() list them.

Noises are immutable, may be compared, copied and pickled, and used by several threads at once.

    noise = solidnoise.gabor(frequency=4, octaves=3, seed=7)
    noise([[0.0, 0.5, 1.0], [2.0, 0.0, 0.0]])                # at points
    noise.lattice(origin=0, step=0.02, shape=(64, 64, 64))   # on a lattice
    noise.power_spectrum([4.0, 0.0, 0.0])                    # known, not measured)");
  of.def(py::init(&make_object), "recipe"_a = py::none(), py::pos_only(), py::kw_only(),
         "dims"_a = py::none(), "time"_a = py::none());
  add_evaluation(of);
  add_closed_forms(of);
  add_state(of);
  const Json schema = noise_recipe_schema();
  std::size_t kind = 0;
  for_each_noise([&]<typename Options>(std::type_identity<Options>) {
    add_kind<Options>(module, schema["oneOf"][kind++]);
  });
}

}  // namespace solidnoise::python
