#pragma once

#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <type_traits>
#include <utility>
#include <variant>

#include "solidnoise/noise/noise.h"
#include "solidnoise/noise/registry/noise_recipe.h"

namespace solidnoise::python {

namespace py = pybind11;

// A noise as callers hold it: of what it is made, and itself. Immutable.
class NoiseObject {
 public:
  // `dims` of its positions, 1 to 4. A noise that changes with time is as it is at `time`, and one of 4
  // dimensions then a slice of 3. Throws std::invalid_argument.
  NoiseObject(NoiseRecipe recipe, int dims, std::optional<double> time);

  const NoiseRecipe& recipe() const { return recipe_; }
  int made_dims() const { return made_dims_; }  // of what it is made, before it is sliced
  std::optional<double> time() const { return time_; }
  int dims() const { return static_cast<int>(noise_.index()) + 1; }

  // Calls visit(const std::shared_ptr<const Noise<Dim>>&).
  template <typename Visit>
  decltype(auto) visit(const Visit& visit) const {
    return std::visit(visit, noise_);
  }

  bool operator==(const NoiseObject& other) const {
    return recipe_ == other.recipe_ && made_dims_ == other.made_dims_ && time_ == other.time_;
  }

 private:
  template <int Dim>
  using NoisePtr = std::shared_ptr<const Noise<Dim>>;

  NoiseRecipe recipe_;
  int made_dims_;
  std::optional<double> time_;
  std::variant<NoisePtr<1>, NoisePtr<2>, NoisePtr<3>, NoisePtr<4>> noise_;
};

// Of a pointer to a noise.
template <typename Pointer>
inline constexpr int kDimOf = 0;
template <int Dim>
inline constexpr int kDimOf<std::shared_ptr<const Noise<Dim>>> = Dim;

// The class of noises, and what it documents.
using NoiseClass = py::class_<NoiseObject, std::shared_ptr<NoiseObject>>;

// Noises, and a function for each kind. The class has what evaluates noises, and what is known of them.
void add_noise(py::module_& module);
void add_evaluation(NoiseClass& of);
void add_closed_forms(NoiseClass& of);

}  // namespace solidnoise::python
