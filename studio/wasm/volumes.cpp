#include <algorithm>
#include <cmath>
#include <cstring>

#include <nlohmann/json.hpp>

#include "pictures.h"
#include "solidnoise/volume/topology/grid_frame.h"

namespace solidnoise::studio {
namespace {

// The voxels of a preview: "dim" along the longest side.
struct Preview {
  VolumeRecipe grid;
  VolumePlan plan;
  FieldPtr field;
};

const Preview& preview_of(const Json& question) {
  static std::string known;
  static Preview preview;
  const std::string key = Json{question.at("recipe"), question.value("grid", ""),
                               question.value("time", Json()), question.at("dim")}
                              .dump();
  if (key != known) {
    known.clear();
    preview.grid = timed_grid(question);
    preview.plan =
        plan_in_box(preview.grid, voxel_size_for_dim(preview.grid.box, question.at("dim").get<int>()));
    preview.field = field_in_shape(preview.grid, preview.plan);
    known = key;
  }
  return preview;
}

}  // namespace

// Values of the first channel in the slab of voxels "first" to first + "count" along x, z fastest. The answer
// says how many there are in all, and between which numbers these are.
Answer make_volume_values(const Json& question, std::span<const unsigned char>) {
  const Preview& preview = preview_of(question);
  Lattice<3> lattice = preview.plan.frame.lattice(preview.plan.voxels);
  const glm::ivec3 whole = lattice.count;
  const int first = question.at("first");
  const int count = std::min(question.at("count").get<int>(), whole.x - first);
  Answer answer{Json{{"size", {whole.x, whole.y, whole.z}}, {"first", first}}};
  if (count <= 0) return answer;
  lattice.first[0] += first;
  lattice.count[0] = count;
  const auto channels = static_cast<std::size_t>(preview.field->channels());
  std::vector<float> values(channels * lattice.size(), 0.0f);
  if (!preview.field->empty(lattice.bounds())) {
    preview.field->block(lattice.bounds())->evaluate(lattice, Samples<3>{values, {}});
  }
  if (channels > 1) {  // of vectors, how long they are
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      float squares = 0.0f;
      for (std::size_t c = 0; c < channels; ++c) squares += std::pow(values[c * lattice.size() + i], 2.0f);
      values[i] = std::sqrt(squares);
    }
    values.resize(lattice.size());
  }
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  answer.json["low"] = *least;
  answer.json["high"] = *greatest;
  answer.floats.push_back(std::move(values));
  return answer;
}

// Densities of "size" voxels as bytes of floats, scaled as the recipe's volume would be, and the optical
// depth from each voxel to a sun in the direction "sun": layer by layer away from it, each from the one
// before, where the ray to the sun meets it.
Answer light_volume(const Json& question, std::span<const unsigned char> bytes) {
  const VolumeRecipe grid = timed_grid(question);
  const Json& size = question.at("size");
  const std::array<int, 3> n{size[0].get<int>(), size[1].get<int>(), size[2].get<int>()};
  std::vector<float> density(bytes.size() / sizeof(float));
  std::memcpy(density.data(), bytes.data(), density.size() * sizeof(float));
  const double voxel = voxel_size_for_dim(grid.box, question.at("dim").get<int>());
  const std::array<std::ptrdiff_t, 3> stride{static_cast<std::ptrdiff_t>(n[1]) * n[2], n[2], 1};

  // The scale: of the thickest column along the up axis, or of the largest density.
  const auto up = static_cast<std::size_t>(vertical_axis(grid));
  const std::size_t a = (up + 1) % 3;
  const std::size_t b = (up + 2) % 3;
  double thickest = 0.0;
  float largest = 0.0f;
  for (int i = 0; i < n[a]; ++i) {
    for (int j = 0; j < n[b]; ++j) {
      double column = 0.0;
      for (int k = 0; k < n[up]; ++k) {
        const float value = density[static_cast<std::size_t>(i * stride[a] + j * stride[b] + k * stride[up])];
        column += value;
        largest = std::max(largest, value);
      }
      thickest = std::max(thickest, column * voxel);
    }
  }
  double factor = 1.0;
  if (grid.density.factor) {
    factor = *grid.density.factor;
  } else if (grid.density.peak) {
    factor = largest > 0.0f ? *grid.density.peak / largest : 1.0;
  } else if (thickest > 0.0) {
    factor = grid.density.optical_depth / thickest;
  }

  const Json& sun_json = question.at("sun");
  Vec<3> sun(sun_json[0].get<double>(), sun_json[1].get<double>(), sun_json[2].get<double>());
  std::size_t main = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(sun[static_cast<int>(axis)]) > std::abs(sun[static_cast<int>(main)])) main = axis;
  }
  const std::size_t u = (main + 1) % 3;
  const std::size_t v = (main + 2) % 3;
  const double along = sun[static_cast<int>(main)];
  const double du = sun[static_cast<int>(u)] / std::abs(along);
  const double dv = sun[static_cast<int>(v)] / std::abs(along);
  const double step = voxel * std::sqrt(1.0 + du * du + dv * dv) * factor;
  std::vector<float> depth(density.size(), 0.0f);
  const int towards = along > 0.0 ? 1 : -1;
  for (int layer = 1; layer < n[main]; ++layer) {
    const int k = towards > 0 ? n[main] - 1 - layer : layer;
    const std::ptrdiff_t before = (k + towards) * stride[main];
    for (int i = 0; i < n[u]; ++i) {
      for (int j = 0; j < n[v]; ++j) {
        const double x = i + du;
        const double y = j + dv;
        const int x0 = static_cast<int>(std::floor(x));
        const int y0 = static_cast<int>(std::floor(y));
        double total = 0.0;
        for (int corner = 0; corner < 4; ++corner) {
          const int cx = x0 + (corner & 1);
          const int cy = y0 + (corner >> 1);
          if (cx < 0 || cy < 0 || cx >= n[u] || cy >= n[v]) continue;
          const double weight = (1.0 - std::abs(x - cx)) * (1.0 - std::abs(y - cy));
          const auto at = static_cast<std::size_t>(before + cx * stride[u] + cy * stride[v]);
          total += weight * (depth[at] + step * density[at]);
        }
        depth[static_cast<std::size_t>(k * stride[main] + i * stride[u] + j * stride[v])] =
            static_cast<float>(total);
      }
    }
  }
  return {Json{{"factor", factor}, {"largest", largest}}, {std::move(depth)}};
}

}  // namespace solidnoise::studio
