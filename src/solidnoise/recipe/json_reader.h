#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "solidnoise/core/choices.h"
#include "solidnoise/core/vec.h"
#include "solidnoise/recipe/json.h"

namespace solidnoise {

// Reads one object of a recipe, key by key. A key that is missing leaves the value as it was; a value of the
// wrong type is refused; finish() refuses keys that nobody asked for. Every error is a std::invalid_argument
// of one line that begins with the path in the tree ("noise.bandwidth is -1; ...").
class JsonReader {
 public:
  // `path` of the object in the tree, empty for the root. The JSON must outlive the reader.
  explicit JsonReader(const Json& object, std::string path = {});

  bool has(const std::string& key) const { return object_.contains(key); }
  // All that there are, in their order.
  std::vector<std::string> keys() const;

  void read(const std::string& key, double& value);
  void read(const std::string& key, int& value);
  void read(const std::string& key, std::uint64_t& value);
  void read(const std::string& key, bool& value);
  void read(const std::string& key, std::string& value);
  void read(const std::string& key, std::optional<double>& value);
  void read(const std::string& key, Box<3>& value);               // x0, y0, z0, x1, y1, z1
  void read(const std::string& key, std::vector<Vec<2>>& pairs);  // an array of arrays of two numbers
  void read(const std::string& key, std::vector<std::string>& texts);

  // An array of arrays of `columns` numbers each; what they are, such as "x y variance", is said where they
  // are not.
  void read_rows(const std::string& key, std::size_t columns, const std::string& what,
                 std::vector<std::vector<double>>& rows);

  // One number for both, or an array of two.
  void read_range(const std::string& key, double& from, double& to);

  template <int Dim>
  void read(const std::string& key, Vec<Dim>& value) {
    double* const components = &value[0];
    read_numbers(key, components, Dim);
  }

  template <std::size_t Count>
  void read(const std::string& key, std::array<double, Count>& numbers) {
    read_numbers(key, numbers.data(), Count);
  }

  template <typename Enum, std::size_t Count>
  void read(const std::string& key, const Choices<Enum, Count>& choices, Enum& value) {
    if (has(key)) value = choices[read_choice(key, names_of(choices))].value;
    note(key);
  }

  // The index in `names` of a text that must be there and must be one of them.
  std::size_t read_choice(const std::string& key, const std::vector<std::string_view>& names);

  // A reader of the object under a key, if there is one.
  std::optional<JsonReader> object(const std::string& key);

  // Readers of the objects of an array under a key, at "key[0]", "key[1]", ...; none if the key is missing.
  // An array must have one at least.
  std::vector<JsonReader> objects(const std::string& key);

  // Runs refusing() and puts the path before what it says.
  template <typename Run>
  void check(const Run& refusing) const {
    try {
      refusing();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(path_of(error.what()));
    }
  }
  template <typename Options>
  void validate(const Options& options) const {
    check([&] { options.validate(); });
  }

  // Refuses an object that has both.
  void refuse_both(const std::string& key, const std::string& other) const;

  // Refuses every key that was not read.
  void finish() const;

  // "noise.bandwidth" for the key "bandwidth" of the object at "noise".
  std::string path_of(const std::string& key) const;

 private:
  const Json* find(const std::string& key);
  void note(const std::string& key);
  void read_numbers(const std::string& key, double* values, std::size_t count);
  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const;

  const Json& object_;
  std::string path_;
  std::vector<std::string> known_keys_;
};

// What every whole recipe begins with: {"solidnoise": 1, "algorithm": 1, ...}. "algorithm" is
// kAlgorithmVersion when the recipe was written. "$schema" may name the recipe's JSON Schema, for editors.
Json recipe_header();

// Reads these keys. Throws std::invalid_argument where "solidnoise" is missing or another version.
void read_recipe_header(JsonReader& reader);

// The algorithm version that a recipe was written with; kAlgorithmVersion if it does not say.
int algorithm_of(const Json& json);

}  // namespace solidnoise
