#pragma once

#include <filesystem>
#include <functional>
#include <pybind11/pybind11.h>
#include <string>

#include "solidnoise/recipe/json.h"

namespace solidnoise::python {

namespace py = pybind11;

// Plain data of Python as JSON: None, bool, int, float, str, list, tuple, dict with keys of str, what NumPy
// has of these, paths, and objects with a `recipe`; for "exemplar" also a whole file of noisefit's, or its
// path. Throws py::type_error for others.
Json json_of(py::handle object);

// JSON as plain data of Python, new for each call.
py::object object_of(const Json& json);

// Puts the values of `changes` in the place of those of a recipe, key by key; objects are merged.
void merge(Json& recipe, const Json& changes);

// Gives `use` a recipe as callers have it: None, a dict or an object with a `recipe`; or the path of a file
// whose text is `text_in` of it. Keywords are merged into it. Throws what `use` throws; of a file,
// std::runtime_error with its path and line. Python warns where a file's recipe was written with another
// version of the algorithms.
void use_recipe(py::handle recipe, const py::dict& keywords, const std::function<void(const Json&)>& use,
                const std::function<std::string(const std::filesystem::path&)>& text_in);
void use_recipe(py::handle recipe, const py::dict& keywords, const std::function<void(const Json&)>& use);

// A whole recipe; one that does not say of which version it is is of this one.
Json with_header(Json recipe);

// A path as Python has it: str, bytes or os.PathLike. Throws py::type_error for others.
std::filesystem::path path_of(py::handle object);
bool is_path(py::handle object);

// Equal for equal numbers, 0 and -0 among them.
std::string hashed_text(Json json);

// For messages: "int".
std::string name_of_type(py::handle object);

}  // namespace solidnoise::python
