#include "json.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <pybind11/stl/filesystem.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "solidnoise/recipe/exemplar_model_json.h"
#include "solidnoise/recipe/recipe_file.h"

namespace solidnoise::python {
namespace {

// Keys of which a recipe has one or the other: one that is given anew takes the place of both.
constexpr std::pair<const char*, const char*> kAlternatives[] = {
    {"dim", "voxel"},        {"frequency", "detail"}, {"optical_depth", "peak"}, {"optical_depth", "density"},
    {"source", "attribute"}, {"displace", "combine"}, {"displace", "amount"}};

// As deep as the library reads, and no deeper: a list may hold itself.
constexpr int kMostDepth = 32;

Json json_of_integer(py::handle object) {
  const unsigned long long natural = PyLong_AsUnsignedLongLong(object.ptr());
  if (PyErr_Occurred() == nullptr) return static_cast<std::uint64_t>(natural);
  PyErr_Clear();
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(object.ptr(), &overflow);
  if (overflow == 0) return static_cast<std::int64_t>(number);
  const double beyond = PyLong_AsDouble(object.ptr());  // what either holds
  if (!PyErr_Occurred()) return beyond;
  PyErr_Clear();
  throw py::value_error("a number of a recipe is too large for any");
}

// The model of an exemplar as recipes have it, where it is what noisefit writes, or the path of a file of
// that.
Json exemplar_of(Json json) {
  ExemplarModel model;
  const auto use = [&](const Json& file) { model = exemplar_file_from_json(file); };
  if (json.is_string()) {
    const std::filesystem::path path = json.get<std::string>();
    solidnoise::read_recipe(path, read_text_file(path), use);
  } else if (json.contains("solidnoise")) {
    use(json);
  } else {
    return json;
  }
  return to_json(model);
}

std::string text_of(py::handle object) {
  if (const char* const text = PyUnicode_AsUTF8(object.ptr())) return text;
  throw py::error_already_set();  // UnicodeEncodeError, a ValueError
}

Json json_of(py::handle object, int depth) {
  if (depth > kMostDepth) throw py::value_error("nested too deeply to be a recipe");
  if (object.is_none()) return nullptr;
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::int_>(object)) return json_of_integer(object);
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::str>(object)) return text_of(object);
  if (py::isinstance<py::dict>(object)) {
    Json json = Json::object();
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(object)) {
      if (!py::isinstance<py::str>(key)) throw py::type_error("a recipe's keys must be texts");
      const std::string name = text_of(key);
      json[name] = json_of(value, depth + 1);
      if (name == "exemplar") json[name] = exemplar_of(std::move(json[name]));
    }
    return json;
  }
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
    Json json = Json::array();
    for (const py::handle item : object) json.push_back(json_of(item, depth + 1));
    return json;
  }
  if (py::hasattr(object, "recipe")) return json_of(object.attr("recipe"), depth + 1);
  if (py::hasattr(object, "tolist")) return json_of(object.attr("tolist")(), depth + 1);
  if (py::hasattr(object, "__fspath__")) return path_of(object).string();
  throw py::type_error("a recipe cannot hold a " + name_of_type(object));
}

}  // namespace

Json json_of(py::handle object) {
  return json_of(object, 0);
}

py::object object_of(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    case Json::value_t::string:
      return py::str(json.get_ref<const std::string&>());
    case Json::value_t::array: {
      py::list list;
      for (const Json& item : json) list.append(object_of(item));
      return list;
    }
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[py::str(key)] = object_of(value);
      return dict;
    }
    default:
      return py::none();
  }
}

void merge(Json& recipe, const Json& changes) {
  for (const auto& [one, other] : kAlternatives) {
    if (changes.contains(one) == changes.contains(other)) continue;
    recipe.erase(changes.contains(one) ? other : one);
  }
  for (const auto& [key, value] : changes.items()) {
    Json& target = recipe[key];
    if (target.is_object() && value.is_object()) {
      merge(target, value);
    } else {
      target = value;
    }
  }
}

void use_recipe(py::handle recipe, const py::dict& keywords, const std::function<void(const Json&)>& use,
                const std::function<std::string(const std::filesystem::path&)>& text_in) {
  const auto use_changed = [&](const Json& json) {
    if (!json.is_object() || keywords.empty()) return use(json);
    Json changed = json;
    merge(changed, json_of(keywords));
    use(changed);
  };
  if (recipe.is_none()) return use_changed(Json::object());
  if (!is_path(recipe)) return use_changed(json_of(recipe));
  const std::filesystem::path path = path_of(recipe);
  const std::string warning = solidnoise::read_recipe(path, text_in(path), use_changed);
  if (!warning.empty() && PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) {
    throw py::error_already_set();
  }
}

void use_recipe(py::handle recipe, const py::dict& keywords, const std::function<void(const Json&)>& use) {
  use_recipe(recipe, keywords, use, read_text_file);
}

Json with_header(Json recipe) {
  if (recipe.is_object() && !recipe.contains("solidnoise")) recipe["solidnoise"] = kRecipeVersion;
  return recipe;
}

std::filesystem::path path_of(py::handle object) {
  if (!is_path(object) && !py::isinstance<py::bytes>(object)) {
    throw py::type_error("a path cannot be a " + name_of_type(object) +
                         "; it must be str, bytes or os.PathLike");
  }
  try {
    const auto path = object.cast<std::filesystem::path>();
    if (path.native().find('\0') == std::string::npos) return path;
  } catch (const py::cast_error&) {
  }
  throw py::value_error("a path must be without null bytes, and of characters that its file system has");
}

std::string hashed_text(Json json) {
  const std::function<void(Json&)> unsign = [&](Json& value) {
    if (value.is_number_float()) value = value.get<double>() + 0.0;
    if (value.is_structured()) std::for_each(value.begin(), value.end(), unsign);
  };
  unsign(json);
  return json.dump();
}

std::string name_of_type(py::handle object) {
  return object.get_type().attr("__name__").cast<std::string>();
}

bool is_path(py::handle object) {
  return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}

}  // namespace solidnoise::python
