#include "noise.h"

#include <functional>
#include <pybind11/stl.h>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include "documentation.h"
#include "evaluation.h"
#include "json.h"
#include "solidnoise/core/check.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/interpolation/interpolated_noise.h"
#include "solidnoise/noise/noise_views.h"
#include "solidnoise/noise/registry/noise_entries.h"
#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/noise_recipe_json.h"
#include "solidnoise/recipe/recipe_file.h"

namespace solidnoise::python {
namespace {

// Of a pointer to a noise.
template <typename Pointer>
inline constexpr int kDimOf = 0;
template <int Dim>
inline constexpr int kDimOf<std::shared_ptr<const Noise<Dim>>> = Dim;

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

// What noisefit writes, as recipes of noises have it; a file of it may be given by its path.
Json exemplar_of(const Json& json) {
  if (json.is_string()) {
    ExemplarModel model;
    const std::string path = json.get<std::string>();
    solidnoise::read_recipe(path, read_text_file(path),
                            [&](const Json& file) { model = exemplar_file_from_json(file); });
    return to_json(model);
  }
  return json.is_object() && json.contains("solidnoise") ? to_json(exemplar_file_from_json(json)) : json;
}

// A whole file of noisefit's with further keys is a noise by example with these.
void unwrap_exemplar(Json& json) {
  if (!json.contains("exemplar")) return;
  if (json.contains("solidnoise")) {
    Json file = Json::object();
    for (const char* const key : {"solidnoise", "algorithm", "$schema", "exemplar"}) {
      if (!json.contains(key)) continue;
      file[key] = json[key];
      json.erase(key);
    }
    json["exemplar"] = std::move(file);
    json["type"] = "spectrum";
  }
  json["exemplar"] = exemplar_of(json["exemplar"]);
}

NoiseObject noise_of_json(Json json, int dims, std::optional<double> time) {
  unwrap_exemplar(json);
  fill_axes(json);
  JsonReader reader(json);
  return {noise_recipe_from_json(reader), dims, time};
}

NoiseObject make_object(py::handle recipe, int dims, std::optional<double> time, const py::kwargs& options) {
  std::optional<NoiseObject> made;
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

// A number for each vector of an array.
template <int Dim, typename Function>
py::object map_vectors(py::handle vectors, const std::string& name, const Function& function) {
  const Rows rows(vectors, name, Dim);
  std::vector<double> results(rows.count());
  run({std::nullopt, py::none()}, [&](Progress& progress) {
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) {
      throw_if_cancelled(&progress);
      results[i] = function(rows.vector<Dim>(i));
    });
  });
  return array_of(std::move(results), rows.shape());
}

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
  const double error = interpolated ? error_of(noise.recipe()) : 0.0;
  return noise.visit([&]<typename Pointer>(const Pointer& field) {
    return evaluate_on_lattice<kDimOf<Pointer>>(field, lattice_of<kDimOf<Pointer>>(place), error, wanted,
                                                call);
  });
}

// The class of noises, and what it documents.
using NoiseClass = py::class_<NoiseObject, std::shared_ptr<NoiseObject>>;

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
    Called with the fraction that is done, some 20 times a second.

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
    Whether waves that the lattice resolves well may be interpolated from fewer samples, within the noise's `error`, as
    volumes do: several times quicker. Values then depend on origin and step, too.

Returns an array of float32 of the shape, C-contiguous, or with the gradient a tuple of it and of the derivatives.)");
}

template <typename Function>
py::object numbers_at(const NoiseObject& noise, py::handle vectors, const std::string& name,
                      const Function& function) {
  return noise.visit([&]<typename Pointer>(const Pointer& field) {
    return map_vectors<kDimOf<Pointer>>(vectors, name,
                                        [&](const auto& vector) { return function(*field, vector); });
  });
}

void add_closed_forms(NoiseClass& of) {
  using namespace py::literals;
  of.def(
      "power_spectrum",
      [](const NoiseObject& noise, py::handle frequency) {
        return numbers_at(noise, frequency, "frequency",
                          [](const auto& of_noise, const auto& f) { return of_noise.power_spectrum(f); });
      },
      "frequency"_a, py::pos_only(),
      R"(power_spectrum(self, frequency, /)
--

The two-sided power spectral density, in closed form, at frequencies, an array (..., dims), cycles per world unit. Its integral
over all frequencies is the variance. Returns float64 (...).)");
  of.def(
      "covariance",
      [](const NoiseObject& noise, py::handle displacement) {
        return numbers_at(noise, displacement, "displacement",
                          [](const auto& of_noise, const auto& x) { return of_noise.covariance(x); });
      },
      "displacement"_a, py::pos_only(),
      R"(covariance(self, displacement, /)
--

The covariance of values so far apart, an array (..., dims), world units: the transform of the power spectrum. Returns float64 (...). Noises that are not stationary (kensler) have none, and give 0.)");
  const auto number = [&](const char* name, auto get, const char* text) {
    of.def_property_readonly(
        name,
        [get](const NoiseObject& noise) {
          return noise.visit([&](const auto& field) { return get(*field); });
        },
        text);
  };
  number(
      "variance", [](const auto& noise) { return noise.variance(); },
      "The variance of values over all seeds, in closed form; the mean is 0.");
  number(
      "excess_kurtosis", [](const auto& noise) { return noise.excess_kurtosis(); },
      "E[n^4] / E[n^2]^2 - 3, in closed form: 0 for a Gaussian field.");
  number(
      "band", [](const auto& noise) { return std::pair(noise.band().lower, noise.band().upper); },
      "The lowest and the highest frequency of the interval that holds all but a thousandth of the variance, "
      "cycles per world unit.");
  number(
      "gradient_variance",
      [](const auto& noise) {
        const auto variance = noise.gradient_variance();
        std::vector<double> axes;
        for (int axis = 0; axis < variance.length(); ++axis) axes.push_back(variance[axis]);
        return array_of(std::move(axes));
      },
      "The variance of each component of the gradient, per world unit squared, in closed form: float64 "
      "(dims,).");
}

// What describe() says of the kernel and of its impulses, in any dimensions.
Json description_of(const NoiseObject& noise) {
  Json json;
  const auto of_kernel = [&](const char* key, const auto& value) { json["kernel"][key] = value; };
  const auto of_noise = [&](const char* key, const auto& value) { json[key] = value; };
  const auto describe = [&]<typename Options>(const Options& whole) {
    using Entry = NoiseEntry<Options>;
    const Options options = with_truncation_share(whole);
    const auto in = [&]<int Dim>(std::integral_constant<int, Dim>) {
      if constexpr (Entry::kLeastDimensions <= Dim && Dim <= Entry::kMostDimensions) {
        if (noise.made_dims() == Dim) Entry::template describe<Dim>(options, of_kernel, of_noise);
      }
    };
    [&]<int... Less>(std::integer_sequence<int, Less...>) {
      (in(std::integral_constant<int, Less + 1>()), ...);
    }
    (std::make_integer_sequence<int, 4>());
  };
  std::visit(describe, noise.recipe().noise);
  return json;
}

void add_state(NoiseClass& of) {
  using namespace py::literals;
  of.def_property_readonly(
      "recipe", [](const NoiseObject& noise) { return object_of(to_json(noise.recipe())); },
      "What the noise is made of, as a new dict: what recipes of volumes have under \"noise\".");
  of.def_property_readonly(
      "description", [](const NoiseObject& noise) { return object_of(description_of(noise)); },
      "What is known of the kernel (\"kernel\": its radius and the like, world units) and of the impulses, "
      "of the first octave, "
      "as a new dict: what describe() has of a volume's noise.");
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
  of.def("__repr__", &represent);
  of.def("__eq__", [](const NoiseObject& noise, py::object other) -> py::object {
    if (!py::isinstance<NoiseObject>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(noise == other.cast<const NoiseObject&>());
  });
  of.def("__hash__",
         [](const NoiseObject& noise) { return std::hash<std::string>()(to_json(noise.recipe()).dump()); });
  of.def(py::pickle(
      [](const NoiseObject& noise) {
        return py::make_tuple(object_of(to_json(noise.recipe())), noise.made_dims(), noise.time());
      },
      [](const py::tuple& state) {
        return make_object(state[0], state[1].cast<int>(), state[2].cast<std::optional<double>>(), {});
      }));
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
                R"(Noise(recipe=None, /, *, dims=3, time=None, **options)
--

A random field with a known spectrum: of mean 0 and, unless it is filtered, variance 1.

recipe : dict, Noise, or the path of a .json file
    The options by name, with "type" for the kind: what recipes of volumes have under "noise". A file may also be a noise by example,
    as noisefit writes it.
dims : int, 1 to 4
    Dimensions of its positions.
time : float
    Of a noise that changes with time: when it is looked at; see at_time().
options
    Take the place of those of the recipe. gabor(), gabor_oriented(), kensler(), cellular() and spectrum() list them.

Noises are immutable, may be compared, copied and pickled, and used by several threads at once.

    noise = solidnoise.gabor(frequency=4, octaves=3, seed=7)
    noise([[0.0, 0.5, 1.0], [2.0, 0.0, 0.0]])                # at points
    noise.lattice(origin=0, step=0.02, shape=(64, 64, 64))   # on a lattice
    noise.power_spectrum([4.0, 0.0, 0.0])                    # known, not measured)");
  of.def(py::init(&make_object), "recipe"_a = py::none(), py::pos_only(), py::kw_only(), "dims"_a = 3,
         "time"_a = py::none());
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
