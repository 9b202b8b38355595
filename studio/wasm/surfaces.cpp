#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "solidnoise/geometry/mesh_file.h"
#include "solidnoise/mesh/bake_mesh.h"
#include "solidnoise/mesh/bake_recipe_json.h"

namespace solidnoise::studio {
namespace {

// The mesh that was loaded last; a worker has one.
PolygonMesh loaded;

std::vector<float> numbers_of(const std::vector<Vec<3>>& vectors) {
  std::vector<float> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec<3>& vector : vectors) {
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<float>(vector[axis]));
  }
  return numbers;
}

}  // namespace

// The bytes of a .ply or .obj, by the question's "name".
Answer load_mesh(const Json& question, std::span<const unsigned char> bytes) {
  const std::string name = question.at("name");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  MeshReading reading = read_mesh(text, mesh_format(name), name);
  loaded = std::move(reading.mesh);
  return {Json{{"vertices", loaded.positions.size()}, {"faces", loaded.face_count()}}};
}

// Positions, normals and colours in linear light of the baked mesh, three numbers a vertex, and its
// triangles' vertices, whole numbers in the bits of the floats.
Answer bake_mesh(const Json& question, std::span<const unsigned char>) {
  BakeRecipe recipe = read_bake_recipe(question.at("recipe"));
  if (question.contains("time")) recipe.noise.time = question.at("time");
  constexpr std::uint64_t kMostMemory = std::uint64_t{1} << 30;
  const BakePlan plan = plan_bake(loaded, recipe, nullptr, kMostMemory);
  const BakedMesh baked = bake(plan, recipe);
  Answer answer{Json{{"mean", baked.moments.mean()},
                     {"sigma", baked.moments.sigma()},
                     {"vertices", baked.mesh.positions.size()},
                     {"cycles_per_edge", plan.mean_cycles_per_edge}}};
  answer.floats.push_back(numbers_of(baked.mesh.positions));
  answer.floats.push_back(numbers_of(baked.normals));
  std::vector<float>& colors = answer.floats.emplace_back();
  for (const Color& color : baked.colors) {
    for (int c = 0; c < 3; ++c) colors.push_back(color[c]);
  }
  std::vector<float>& corners = answer.floats.emplace_back();
  for (const Triangle& triangle : triangulate(baked.mesh)) {
    for (const std::uint32_t vertex : triangle) corners.push_back(std::bit_cast<float>(vertex));
  }
  return answer;
}

BakeRecipe read_bake_recipe(const std::string& text) {
  try {
    return bake_recipe_from_json(parse_json(text));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(with_line(text, error.what()));
  }
}

}  // namespace solidnoise::studio
