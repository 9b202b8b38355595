#include <pybind11/stl.h>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include "arrays.h"
#include "call.h"
#include "json.h"
#include "noise.h"
#include "solidnoise/core/check.h"
#include "solidnoise/noise/error_budget.h"
#include "solidnoise/noise/registry/noise_entries.h"

namespace solidnoise::python {
namespace {

// A number for each vector of an array.
template <int Dim, typename Function>
py::object map_vectors(py::handle vectors, const std::string& name, const Function& function) {
  const Rows rows(vectors, name, Dim);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    for (int axis = 0; axis < Dim; ++axis) require_finite(name, rows.vector<Dim>(i)[axis]);
  }
  std::vector<double> results(rows.count());
  run({std::nullopt, py::none()}, [&](Progress& progress) {
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) {
      throw_if_cancelled(&progress);
      results[i] = function(rows.vector<Dim>(i));
    });
  });
  return array_of(std::move(results), rows.shape());
}

template <typename Function>
py::object numbers_at(const NoiseObject& noise, py::handle vectors, const std::string& name,
                      const Function& function) {
  return noise.visit([&]<typename Pointer>(const Pointer& field) {
    return map_vectors<kDimOf<Pointer>>(vectors, name,
                                        [&](const auto& vector) { return function(*field, vector); });
  });
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

}  // namespace

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

The covariance of values so far apart, an array (..., dims), world units: the transform of the power spectrum, but for the
noise's error, of 1 dimension up to 0.015. Of a noise with a period it is that of the same noise without one: that of the values is
its sum over displacements that are periods apart. Returns float64 (...). Noises that are not stationary (kensler) have none, and
give 0.)");
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
  of.def_property_readonly(
      "description", [](const NoiseObject& noise) { return object_of(description_of(noise)); },
      "What is known of the kernel (\"kernel\": its radius and the like, world units) and of the impulses, "
      "of the first octave, "
      "as a new dict: what describe() has of a volume's noise.");
}

}  // namespace solidnoise::python
