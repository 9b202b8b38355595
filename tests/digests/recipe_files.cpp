#include "digests/recipe_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "support/paths.h"

namespace solidnoise {

Json read_json(const std::string& path) {
  std::ifstream file(in_source(path));
  if (!file) throw std::runtime_error("cannot read " + in_source(path));
  return parse_json(std::string(std::istreambuf_iterator<char>(file), {}));
}

std::map<std::string, Json> recipes_in(const std::string& folder) {
  std::map<std::string, Json> recipes;
  for (const auto& entry : std::filesystem::directory_iterator(in_source(folder))) {
    if (entry.path().extension() != ".json") continue;
    recipes[entry.path().stem().string()] = read_json(folder + "/" + entry.path().filename().string());
  }
  return recipes;
}

}  // namespace solidnoise
