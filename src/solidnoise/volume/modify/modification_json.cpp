#include "solidnoise/volume/modify/modification_json.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solidnoise/volume/vdb/grid_file_json.h"

namespace solidnoise {
namespace {

constexpr std::array kKeys{"on", "combine", "amount", "displace", "mask", "rest"};

void refuse_both(const JsonReader& reader, const char* one, const char* other) {
  if (!reader.has(one) || !reader.has(other)) return;
  throw std::invalid_argument(fmt::format("{} and {} contradict each other; give one of them", one, other));
}

}  // namespace

void add_modification(Json& recipe, const Modification& modification) {
  if (!modification.on.file.empty()) add_grid_file(recipe["on"], modification.on);
  if (modification.displace) {
    recipe["displace"] = *modification.displace;
  } else {
    recipe["combine"] = name_of(kCombineChoices, modification.combine);
    if (modification.combine != Combine::replace) recipe["amount"] = modification.amount;
  }
  if (modification.mask) add_grid_file(recipe["mask"], *modification.mask);
  if (modification.rest) add_grid_file(recipe["rest"], *modification.rest);
}

void read_modification(JsonReader& reader, std::optional<Modification>& modification) {
  refuse_both(reader, "combine", "displace");
  refuse_both(reader, "amount", "displace");
  Modification read;
  std::optional<GridFile> on;
  read_grid_file(reader, "on", on);
  if (on) read.on = *on;
  reader.read("combine", kCombineChoices, read.combine);
  reader.read("amount", read.amount);
  reader.read("displace", read.displace);
  read_grid_file(reader, "mask", read.mask);
  read_grid_file(reader, "rest", read.rest);
  if (std::any_of(kKeys.begin(), kKeys.end(), [&](const char* key) { return reader.has(key); })) {
    modification = read;
  }
}

}  // namespace solidnoise
