#include "solidnoise/volume/modify/modification_json.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/recipe/field_json.h"

namespace solidnoise {
namespace {

void refuse_both(const JsonReader& reader, const char* one, const char* other) {
  if (!reader.has(one) || !reader.has(other)) return;
  throw std::invalid_argument(fmt::format("{} and {} contradict each other; give one of them", one, other));
}

}  // namespace

void add_modification(Json& recipe, const Modification& modification) {
  write_fields(modification, recipe);
}

void read_modification(JsonReader& reader, std::optional<Modification>& modification) {
  refuse_both(reader, "combine", "displace");
  refuse_both(reader, "amount", "displace");
  Modification read;
  read_fields(reader, read);
  for_each_field(read, [&](const auto& field, const auto&) {
    if (reader.has(std::string(field.name))) modification = read;
  });
}

}  // namespace solidnoise
