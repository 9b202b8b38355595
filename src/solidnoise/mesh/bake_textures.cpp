#include "solidnoise/mesh/bake_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/core/printable.h"
#include "solidnoise/mesh/bake_cost.h"
#include "solidnoise/mesh/bake_values.h"
#include "solidnoise/mesh/surface_field.h"
#include "solidnoise/mesh/tangent_frames.h"
#include "solidnoise/mesh/texture_padding.h"

namespace solidnoise {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 17;  // texels that are evaluated together

int channels_of(const TextureMap& map) {
  return map.kind == TextureMap::Kind::number ? 1 : 3;
}

int channels_of(const std::vector<TextureMap>& maps) {
  int channels = 0;
  for (const TextureMap& map : maps) channels += channels_of(map);
  return channels;
}

// Those that keep inside of the triangle.
Vec<3> inside(const Vec<3>& weights) {
  const Vec<3> positive = glm::max(weights, Vec<3>(0.0));
  return positive / (positive.x + positive.y + positive.z);
}

template <typename T>
T mixed(const std::vector<T>& of_vertices, const TextureTriangle& triangle, const Vec<3>& weights) {
  T sum{};
  for (int i = 0; i < 3; ++i) {
    const T& value = of_vertices[triangle.vertices[static_cast<std::size_t>(i)]];
    sum += static_cast<T>(weights[i] * value);
  }
  return sum;
}

Vec<3> mixed(const std::vector<Vec<3>>& of_vertices, const TextureTriangle& triangle, const Vec<3>& weights) {
  Vec<3> sum(0.0);
  for (int i = 0; i < 3; ++i) sum += weights[i] * of_vertices[triangle.vertices[static_cast<std::size_t>(i)]];
  return sum;
}

Vec<3> mixed_lines(const std::vector<Vec<3>>& lines, const TextureTriangle& triangle, const Vec<3>& weights) {
  LineMean mean;
  for (int i = 0; i < 3; ++i) mean.add(lines[triangle.vertices[static_cast<std::size_t>(i)]], weights[i]);
  return mean.line();
}

double deviation_at(const TexturePlan& plan, const TextureTriangle& triangle, const Vec<3>& inner) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    sum += inner[i] * static_cast<double>(plan.deviations[triangle.vertices[static_cast<std::size_t>(i)]]);
  }
  return sum;
}

// On the plane of the triangle, as far as that is to be trusted: the planes of needles say little.
Vec<3> place_of(const TexturePlan& plan, const TextureTriangle& triangle, const Vec<3>& weights) {
  constexpr double kFarthest = 8.0;  // deviations: four texels
  const Vec<3> inner = inside(weights);
  const Vec<3> nearest = mixed(plan.bake.mesh.positions, triangle, inner);
  const Vec<3> place = mixed(plan.bake.mesh.positions, triangle, weights);
  return glm::length(place - nearest) > kFarthest * deviation_at(plan, triangle, inner) ? nearest : place;
}

VertexNumber number_of_texels(const VertexNumber& number, std::size_t count) {
  VertexNumber result{number.constant, {}};
  if (number.varies()) result.values.resize(count);
  return result;
}

constexpr std::array kParameters{&VertexParameters::frequency, &VertexParameters::bandwidth,
                                 &VertexParameters::magnitude, &VertexParameters::bias};

// The normal of the surface that is raised by the height, in the frame of the texture coordinates at a texel.
// The frame is what renderers make of normals and tangents of vertices (MikkTSpace): mixed, not made
// perpendicular.
Vec<3> tangent_normal(const TexturePlan& plan, const TextureTriangle& triangle, const Vec<3>& inner,
                      const Vec<3>& slope) {
  const Vec<3> mixed_normal = mixed(plan.bake.guides.normals, triangle, inner);
  const Vec<3> normal = glm::normalize(mixed_normal);
  Vec<3> tangent(0.0);
  for (int i = 0; i < 3; ++i) tangent += inner[i] * triangle.tangents[static_cast<std::size_t>(i)];
  const Vec<3> bitangent = (triangle.mirrored ? -1.0 : 1.0) * glm::cross(mixed_normal, tangent);
  const Vec<3> raised = glm::normalize(normal - (slope - glm::dot(slope, normal) * normal));
  const glm::dmat3 frame(tangent, bitangent, mixed_normal);
  if (std::abs(glm::determinant(frame)) < 1e-9) return {0.0, 0.0, 1.0};
  return glm::normalize(glm::inverse(frame) * raised);
}

BakeWishes wishes_of(const std::vector<TextureMap>& maps) {
  BakeWishes wishes;
  for (const TextureMap& map : maps) {
    wishes.colors = wishes.colors || map.kind == TextureMap::Kind::color;
    wishes.slopes = wishes.slopes || map.kind == TextureMap::Kind::normal;
    if (!map.property.empty()) wishes.properties.push_back(map.property);
  }
  return wishes;
}

// The plan's texels of these numbers.
BakePlan some_of(const BakePlan& plan, const std::vector<std::uint32_t>& numbers) {
  BakePlan some;
  some.bounds = plan.bounds;
  some.feature_size = plan.feature_size;
  const auto pick = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    to.reserve(numbers.size());
    for (const std::uint32_t number : numbers) to.push_back(from[number]);
  };
  pick(plan.mesh.positions, some.mesh.positions);
  pick(plan.guides.normals, some.guides.normals);
  pick(plan.guides.smooth_normals, some.guides.smooth_normals);
  pick(plan.guides.directions, some.guides.directions);
  pick(plan.guides.steering.weights, some.guides.steering.weights);
  for (const auto parameter : kParameters) {
    (some.parameters.*parameter).constant = (plan.parameters.*parameter).constant;
    pick((plan.parameters.*parameter).values, (some.parameters.*parameter).values);
  }
  return some;
}

// The plan of texels as if they were vertices: their places and what the recipe varies there, unfiltered.
BakePlan plan_of_texels(const TexturePlan& plan, const TextureTile& tile, std::span<const Texel> texels) {
  const std::size_t count = texels.size();
  const VertexGuides& guides = plan.bake.guides;
  const VertexParameters& parameters = plan.bake.parameters;
  BakePlan result;
  result.feature_size = plan.bake.feature_size;
  result.bounds = plan.bake.bounds;
  result.mesh.positions.resize(count);
  result.guides.normals.resize(count);
  result.guides.smooth_normals.resize(guides.smooth_normals.empty() ? 0 : count);
  result.guides.directions.resize(guides.directions.empty() ? 0 : count);
  result.guides.steering.weights.resize(guides.steering.weights.empty() ? 0 : count);
  for (const auto parameter : kParameters)
    result.parameters.*parameter = number_of_texels(parameters.*parameter, count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const TextureTriangle& triangle = plan.triangles[texels[i].triangle];
    const Vec<3> weights = weights_at(plan, tile, texels[i]);
    const Vec<3> inner = inside(weights);
    result.mesh.positions[i] = place_of(plan, triangle, weights);
    result.guides.normals[i] = mixed(guides.normals, triangle, inner);
    if (!guides.smooth_normals.empty())
      result.guides.smooth_normals[i] = mixed(guides.smooth_normals, triangle, inner);
    if (!guides.directions.empty())
      result.guides.directions[i] = mixed_lines(guides.directions, triangle, inner);
    if (!guides.steering.weights.empty())
      result.guides.steering.weights[i] = mixed(guides.steering.weights, triangle, inner);
    for (const auto parameter : kParameters) {
      const VertexNumber& number = parameters.*parameter;
      if (number.varies()) (result.parameters.*parameter).values[i] = mixed(number.values, triangle, inner);
    }
  });
  return result;
}

// The texels of a tile, some at a time.
class TileBake {
 public:
  TileBake(const TexturePlan& plan, const BakeRecipe& recipe, const std::vector<TextureMap>& maps,
           const TextureTile& tile)
      : plan_(plan),
        recipe_(recipe),
        maps_(maps),
        tile_(tile),
        wishes_(wishes_of(maps)),
        levels_(levels(plan)) {}

  void add(std::span<const Texel> texels, std::vector<Image>& images, Progress* progress) {
    const BakePlan all = plan_of_texels(plan_, tile_, texels);
    const std::size_t count = levels_.deviations().size();
    std::vector<std::vector<std::uint32_t>> numbers(count);
    std::vector<std::vector<double>> shares(count);
    std::vector<Vec<3>> inner(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
      inner[i] = inside(weights_at(plan_, tile_, texels[i]));
      const auto place = levels_.at(deviation_at(plan_, triangle(texels[i]), inner[i]));
      for (const std::size_t next : {std::size_t{0}, std::size_t{1}}) {
        const double share = next == 0 ? 1.0 - place.share : place.share;
        if (share == 0.0) continue;
        numbers[place.level + next].push_back(static_cast<std::uint32_t>(i));
        shares[place.level + next].push_back(share);
      }
    }
    slopes_.assign(wishes_.slopes ? texels.size() : 0, Vec<3>(0.0));
    for (std::size_t level = 0; level < count; ++level) {
      if (numbers[level].empty()) continue;
      BakePlan plan = some_of(all, numbers[level]);
      plan.filter = levels_.deviations()[level];
      PartialProgress quiet(progress, 0.0, 0.0);
      const BakedValues values = bake_values(plan, recipe_, wishes_, &quiet);
      for (std::size_t k = 0; k < numbers[level].size(); ++k) {
        add_texel(texels, numbers[level][k], shares[level][k], values, k, images);
      }
    }
    set_normals(texels, inner, images);
  }

 private:
  static FilterLevels levels(const TexturePlan& plan) {
    double least = plan.most_deviation();
    for (const TextureTriangle& triangle : plan.triangles) {
      for (const std::uint32_t vertex : triangle.vertices)
        least = std::min(least, static_cast<double>(plan.deviations[vertex]));
    }
    return {least, plan.most_deviation()};
  }

  const TextureTriangle& triangle(const Texel& texel) const { return plan_.triangles[texel.triangle]; }

  static void add_to(Image& image, std::uint32_t texel, std::size_t channel, double value) {
    image.pixels[static_cast<std::size_t>(texel) * static_cast<std::size_t>(image.channels) + channel] +=
        static_cast<float>(value);
  }

  // Value k, of texel `number`.
  void add_texel(std::span<const Texel> texels, std::uint32_t number, double share, const BakedValues& values,
                 std::size_t k, std::vector<Image>& images) {
    std::size_t property = 0;
    for (std::size_t m = 0; m < maps_.size(); ++m) {
      const std::uint32_t texel = texels[number].index;
      if (maps_[m].kind == TextureMap::Kind::color) {
        for (int c = 0; c < 3; ++c)
          add_to(images[m], texel, static_cast<std::size_t>(c), share * values.colors[k][c]);
      } else if (maps_[m].kind == TextureMap::Kind::number) {
        const std::vector<float>& numbers =
            maps_[m].property.empty() ? values.noise : values.properties[property++];
        add_to(images[m], texel, 0, share * numbers[k]);
      }
    }
    if (wishes_.slopes) slopes_[number] += share * values.slopes[k];
  }

  void set_normals(std::span<const Texel> texels, const std::vector<Vec<3>>& inner,
                   std::vector<Image>& images) {
    const double height = height_of_normals(plan_.bake, recipe_);
    for (std::size_t m = 0; m < maps_.size(); ++m) {
      if (maps_[m].kind != TextureMap::Kind::normal) continue;
      for (std::size_t i = 0; i < texels.size(); ++i) {
        const Vec<3> normal = tangent_normal(plan_, triangle(texels[i]), inner[i], height * slopes_[i]);
        for (int c = 0; c < 3; ++c)
          add_to(images[m], texels[i].index, static_cast<std::size_t>(c), 0.5 + 0.5 * normal[c]);
      }
    }
  }

  const TexturePlan& plan_;
  const BakeRecipe& recipe_;
  const std::vector<TextureMap>& maps_;
  const TextureTile& tile_;
  BakeWishes wishes_;
  FilterLevels levels_;
  std::vector<Vec<3>> slopes_;
};

std::vector<std::string> texture_map_names(const BakeRecipe& recipe) {
  std::vector<std::string> names{"color", "normal", "height", "noise"};
  for (const auto& [name, layer] : recipe.properties) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

TextureMap texture_map(std::string_view name, const BakeRecipe& recipe) {
  const std::string text(name);
  if (text == "color") return {text, TextureMap::Kind::color};
  if (text == "normal") return {text, TextureMap::Kind::normal};
  if (recipe.properties.contains(text)) return {text, TextureMap::Kind::number, text};
  if (text == "noise" || text == kHeightProperty) return {text, TextureMap::Kind::number};
  throw std::invalid_argument(fmt::format("map is {}; with this recipe it must be one of {}", printable(text),
                                          fmt::join(texture_map_names(recipe), ", ")));
}

double height_of_normals(const BakePlan& plan, const BakeRecipe& recipe) {
  constexpr double kFeatureShare = 0.1;
  return recipe.displace != 0.0 ? recipe.displace : kFeatureShare * plan.feature_size;
}

FilterLevels::FilterLevels(double least, double greatest) {
  constexpr double kVarianceRatio = 1.5;
  constexpr double kSame = 1.01;          // deviations that need no levels between them
  constexpr double kFarthest = 1.0 / 64;  // what is finer next to the coarsest is as if it were of this
  least = std::max(least, kFarthest * greatest);
  if (greatest <= kSame * least) {
    deviations_ = {greatest};
    return;
  }
  const int steps =
      static_cast<int>(std::ceil(2.0 * std::log(greatest / least) / std::log(kVarianceRatio) - 1e-9));
  for (int i = 0; i <= steps; ++i)
    deviations_.push_back(least * std::pow(greatest / least, static_cast<double>(i) / steps));
}

FilterLevels::Place FilterLevels::at(double deviation) const {
  const auto above = std::upper_bound(deviations_.begin(), deviations_.end(), deviation);
  if (above == deviations_.begin()) return {0, 0.0};
  const auto level = static_cast<std::size_t>(above - deviations_.begin()) - 1;
  if (above == deviations_.end()) return {level, 0.0};
  const double low = deviations_[level] * deviations_[level];
  const double high = *above * *above;
  return {level, (deviation * deviation - low) / (high - low)};
}

BakedTile bake_tile(const TexturePlan& plan, const BakeRecipe& recipe, const std::vector<TextureMap>& maps,
                    const TextureTile& tile, Progress* progress) {
  BakedTile baked;
  for (const TextureMap& map : maps)
    baked.images.emplace_back(plan.options.size, plan.options.size, channels_of(map));
  const TileTexels found = find_texels(plan, tile);
  const std::span<const Texel> texels = found.texels;
  baked.covered = texels.size();
  baked.overlapped = found.overlapped;
  TileBake bake(plan, recipe, maps, tile);
  for (std::size_t first = 0; first < texels.size(); first += kChunk) {
    throw_if_cancelled(progress);
    bake.add(texels.subspan(first, std::min(kChunk, texels.size() - first)), baked.images, progress);
    if (progress) progress->advance(std::min(first + kChunk, texels.size()), texels.size());
  }
  TexturePadding padding(plan.options.size, texels);
  for (int round = 0; round < plan.options.padding; ++round) padding.grow(baked.images);
  return baked;
}

// Images, one of them again as it is written, texels with their triangles, and what is known of those that
// are evaluated together: measured.
double texture_memory(const TexturePlan& plan, const std::vector<TextureMap>& maps) {
  constexpr double kTexel = 24.0;
  constexpr double kEvaluated = 700.0;
  constexpr double kTriangle = 400.0;
  const double texels = static_cast<double>(plan.options.size) * plan.options.size;
  return texels * (kTexel + 4.0 * channels_of(maps) + 3.0 * 12.0) + kEvaluated * static_cast<double>(kChunk) +
         kTriangle * static_cast<double>(plan.triangles.size());
}

double texture_seconds(const TexturePlan& plan, const BakeRecipe& recipe,
                       const std::vector<TextureMap>& maps) {
  BakePlan texels;
  texels.parameters = plan.bake.parameters;
  texels.mesh.positions.resize(1);
  const BakeWishes wishes = wishes_of(maps);
  const double evaluations = 2.0 * (wishes.slopes ? 3.0 : 1.0);
  return plan.texels * evaluations * bake_cost(texels, recipe).seconds;
}

double cycles_per_texel(const TexturePlan& plan) {
  return 2.0 * plan.most_deviation() * plan.bake.highest_frequency;
}

bool filters_all(const BakeRecipe& recipe) {
  const NoiseRecipe own = noise_of_layers(recipe.noise);
  const auto may = [&](const std::vector<Layer>& layers) {
    const std::vector<NoiseRecipe> noises = noises_of(layers, own, recipe.fields);
    return std::all_of(noises.begin(), noises.end(),
                       [&](const NoiseRecipe& noise) { return may_filter(recipe.noise, noise); });
  };
  const auto may_property = [&](const auto& property) { return may({property.second}); };
  return (recipe.layers.empty() || may(recipe.layers)) && may_filter(recipe.noise) &&
         std::ranges::all_of(recipe.properties, may_property);
}

}  // namespace solidnoise
