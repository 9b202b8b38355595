#include "solidnoise/field/cloud_edge.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "solidnoise/field/shaping.h"

namespace solidnoise {
namespace {

// The lobes: |n| with its peaks pressed down; below 2. Its mean over a Gaussian n is about kMeanLobe.
constexpr float kMeanLobe = 0.75f;
constexpr float kHighestLobe = 2.0f;

float lobe(float n) {
  const float height = std::abs(n);
  return 2.0f * height / (1.0f + height);
}

// Beyond this many depths outside of a surface no lobes grow on it. Peaks of the noise far out would come
// loose, and float beside the cloud.
constexpr float kGrowth = 1.5f;
// The farthest that a surface can move outward, in depths: there displaced() is 0 for the highest lobe.
constexpr float kFarthest = (kHighestLobe - kMeanLobe) / (1.0f + (kHighestLobe - kMeanLobe) / kGrowth);

// The distance after lobes of a depth: lowered by depth (lobe - kMeanLobe), outside of the surface by less
// and less with the distance, and not at all from kGrowth depths on.
float displaced(float distance, float depth, float lobe) {
  const float change = depth * (lobe - kMeanLobe);
  if (change <= 0.0f || distance <= 0.0f) return distance - change;
  return distance - change * std::max(0.0f, 1.0f - distance / (kGrowth * depth));
}

constexpr float kSoftest = 3.0f;  // greatest width of the edge over its least

class CloudEvaluation {
 public:
  CloudEvaluation(const CloudModel& model, const PuffUnion& pile) : model_(model), pile_(pile) {}

  std::vector<CloudEdge> operator()(std::span<const Vec<3>> positions, std::size_t groups,
                                    const OctaveValues& noise) const {
    if (positions.empty()) return {};
    const std::size_t size = positions.size() / groups;
    std::vector<Surface> surfaces;
    for (std::size_t i = 0; i < groups; ++i) surfaces.push_back(begin(positions.subspan(i * size, size)));
    for (std::size_t k = 0; k < model_.octaves.size(); ++k) displace(k, noise, surfaces);
    std::vector<CloudEdge> edges;
    for (Surface& s : surfaces) {
      keep_inside(s.p, s.distance);
      edges.push_back(edge_of(s));
    }
    return edges;
  }

 private:
  // The state of a group's samples while octaves are applied.
  struct Surface {
    std::array<std::vector<float>, 3> p;  // in the cloud's frame
    std::vector<float> depth;             // distance before all octaves
    std::vector<float> distance;
    std::vector<float> weight;    // of the next octave; small in the creases of the last ones
    std::vector<float> softness;  // 0 to 1
    std::vector<float> fine;      // the last octave's noise
    bool decided = false;         // further octaves change nothing
  };

  Surface begin(std::span<const Vec<3>> positions) const {
    const std::size_t count = positions.size();
    Surface s;
    Box<3> bounds{model_.to_cloud(positions.front()), model_.to_cloud(positions.front())};
    for (auto& axis : s.p) axis.reserve(count);
    for (const Vec<3>& position : positions) {
      const Vec<3> q = model_.to_cloud(position);
      for (int axis = 0; axis < 3; ++axis) {
        s.p[static_cast<std::size_t>(axis)].push_back(static_cast<float>(q[axis]));
      }
      bounds = {glm::min(bounds.lower, q), glm::max(bounds.upper, q)};
    }
    s.distance.resize(count);
    pile_.within(bounds).evaluate({s.p[0], s.p[1], s.p[2]}, s.distance);
    cut_base(s.p[1], s.distance);
    s.depth = s.distance;
    s.weight.assign(count, 1.0f);
    s.softness.assign(count, 0.0f);
    s.fine.assign(count, 0.0f);
    return s;
  }

  // Applies octave k where it can decide something.
  void displace(std::size_t k, const OctaveValues& noise, std::vector<Surface>& surfaces) const {
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      Surface& s = surfaces[i];
      const auto [lowest, highest] = std::minmax_element(s.distance.begin(), s.distance.end());
      s.decided |= *lowest > model_.outward[k] || *highest < -model_.inward[k] - model_.widest_edge;
      if (!s.decided) wanted.push_back(i);
    }
    if (wanted.empty()) return;
    const std::size_t size = surfaces.front().distance.size();
    std::vector<float> values(wanted.size() * size);
    noise(k, wanted, values);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      displace(k, std::span(values).subspan(i * size, size), surfaces[wanted[i]]);
    }
  }

  // Rounded maximum of the pile's distance and that to the floor.
  void cut_base(const std::vector<float>& height, std::vector<float>& distance) const {
    const float k = model_.floor_rounding;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const float below = -height[i];
      const float mix = std::max(0.0f, 1.0f - std::abs(distance[i] - below) / k);
      distance[i] = std::max(distance[i], below) + 0.25f * k * mix * mix;
    }
  }

  // Lobes that would leave the box are pressed flat.
  void keep_inside(const std::array<std::vector<float>, 3>& p, std::vector<float>& distance) const {
    const CloudModel& m = model_;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const float wall = std::max({std::abs(p[0][i]) - m.walls[0], std::abs(p[2][i]) - m.walls[1],
                                   p[1][i] - m.roof, -p[1][i] - m.cellar});
      distance[i] = std::max(distance[i], wall);
    }
  }

  void displace(std::size_t k, std::span<const float> n, Surface& s) const {
    const std::vector<float>& height = s.p[1];
    const float base = static_cast<float>(model_.shaping.base);
    for (std::size_t i = 0; i < n.size(); ++i) {
      const float l = lobe(n[i]);
      const float grown = base + (1.0f - base) * smoothstep(height[i] / model_.foot);
      s.distance[i] = displaced(s.distance[i], model_.depths[k] * grown * s.weight[i], l);
      s.weight[i] = std::min(1.0f, s.weight[i] * (0.25f + 1.1f * l));
      if (k == 0) s.softness[i] = smoothstep(0.5f - 0.6f * n[i]);
      s.fine[i] = n[i];
    }
  }

  // Eroded where it is thin.
  CloudEdge edge_of(const Surface& s) const {
    const auto wisps = static_cast<float>(model_.shaping.wisps);
    const auto core = static_cast<float>(model_.shaping.core);
    CloudEdge edge;
    for (std::size_t i = 0; i < s.distance.size(); ++i) {
      const float at_base = 1.0f - smoothstep(s.p[1][i] / model_.foot);
      const float soft = std::max(s.softness[i], at_base);
      const float width = model_.edge * (1.0f + (kSoftest - 1.0f) * soft);
      const float t = -s.distance[i] / width;
      const float thin = std::clamp(1.0f - t, 0.0f, 1.0f);
      edge.level.push_back(width * (t - wisps * thin * 0.5f * std::abs(s.fine[i]) - 0.5f));
      edge.width.push_back(width);
      edge.within.push_back(1.0f - core + core * smoothstep(-s.depth[i] / model_.core_depth));
    }
    return edge;
  }

  const CloudModel& model_;
  const PuffUnion& pile_;
};

void set_lobes(const CloudParts& parts, CloudModel& model) {
  const std::size_t count = parts.octaves.size();
  model.octaves = parts.octaves;
  model.outward.assign(count + 1, 0.0f);
  model.inward.assign(count + 1, 0.0f);
  for (const Octave& octave : parts.octaves) {
    model.depths.push_back(static_cast<float>(parts.shaping.lobes * parts.wavelength * octave.amplitude));
  }
  for (std::size_t k = count; k-- > 0;) {
    model.outward[k] = model.outward[k + 1] + model.depths[k] * kFarthest;
    model.inward[k] = model.inward[k + 1] + model.depths[k] * kMeanLobe;
  }
}

}  // namespace

CloudModel make_cloud_model(const CloudParts& parts) {
  CloudModel model;
  model.shaping = parts.shaping;
  model.voxel = parts.voxel;
  set_lobes(parts, model);
  model.edge = static_cast<float>(parts.shaping.edge * parts.wavelength);
  model.widest_edge = kSoftest * model.edge;
  model.up = parts.up;

  // Place the pile so that few lobes can reach the sides of the box.
  const int vertical = parts.up == UpAxis::y ? 1 : 2;
  const Vec<3> size = parts.box.upper - parts.box.lower;
  const double margin = std::min(0.6 * model.outward.front(), 0.2 * std::min({size.x, size.y, size.z}));
  model.ground = (parts.box.lower + parts.box.upper) * 0.5;
  model.ground[vertical] = parts.box.lower[vertical] + margin;
  PuffPile pile;
  pile.size = Vec<3>(size.x, size[vertical], size[3 - vertical]) - 2.0 * margin;
  pile.count = parts.shaping.puffs;
  pile.lean = parts.shaping.lean;
  pile.seed = parts.seed;
  model.pile = PuffUnion(pile_puffs(pile), 0.03 * pile.size.y);
  model.walls = {static_cast<float>(0.5 * size.x), static_cast<float>(0.5 * size[3 - vertical])};
  model.roof = static_cast<float>(size[vertical] - margin);
  model.cellar = static_cast<float>(margin);
  model.foot = static_cast<float>(0.18 * pile.size.y);
  model.core_depth = static_cast<float>(0.25 * pile.size.y);
  model.floor_rounding = static_cast<float>(0.06 * pile.size.y);
  return model;
}

std::vector<CloudEdge> cloud_edges(const CloudModel& model, const PuffUnion& pile,
                                   std::span<const Vec<3>> positions, std::size_t groups,
                                   const OctaveValues& noise) {
  return CloudEvaluation(model, pile)(positions, groups, noise);
}

}  // namespace solidnoise
