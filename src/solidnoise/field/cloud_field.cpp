#include "solidnoise/field/cloud_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <glm/common.hpp>

#include "solidnoise/field/cloud_puffs.h"
#include "solidnoise/field/edge_cover.h"
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

// All that evaluation needs, made once. Lengths in world units.
struct CloudModel {
  CloudShaping shaping;
  std::vector<Octave> octaves;
  std::vector<float> depths;  // of each octave's lobes
  // How far the surface may still move outward and inward from octave k on; 0 after the last one.
  std::vector<float> outward;
  std::vector<float> inward;
  float edge = 0.0f;         // least width of the soft edge
  float widest_edge = 0.0f;  // greatest one
  float foot = 0.0f;         // height over which lobes grow to their full depth
  float core_depth = 0.0f;   // at which the core is densest
  float floor_rounding = 0.0f;
  std::array<float, 2> walls{};  // half extents of the room above the ground; all of it is within
  float roof = 0.0f;             // height of the top of the room
  float cellar = 0.0f;           // depth of the room below the ground
  Vec<3> ground{0.0};            // where the cloud's frame has its origin
  UpAxis up = UpAxis::y;
  PuffUnion pile{{}, 1.0};
  Vec<3> voxel{0.0};

  // Of all that a box's samples depend on.
  Box<3> with_neighbours(const Box<3>& world) const { return {world.lower - voxel, world.upper + voxel}; }

  // From the world to the cloud's own frame, in which y is up.
  Vec<3> to_cloud(const Vec<3>& world) const {
    const Vec<3> p = world - ground;
    return up == UpAxis::y ? p : Vec<3>(p.x, p.z, -p.y);
  }
  Box<3> to_cloud(const Box<3>& world) const {
    const Vec<3> a = to_cloud(world.lower);
    const Vec<3> b = to_cloud(world.upper);
    return {glm::min(a, b), glm::max(a, b)};
  }
};

constexpr float kSoftest = 3.0f;  // greatest width of the edge over its least

// Densities below this are taken for nothing: what cannot be seen needs no voxels.
constexpr float kLeastDensity = 1e-3f;

// The edge of a cloud at some samples, see edge_cover(), and the density that there is within.
struct CloudEdge {
  std::vector<float> level;
  std::vector<float> width;
  std::vector<float> within;
};

float density(float cover, float within) {
  const float result = cover * within;
  return result < kLeastDensity ? 0.0f : result;
}

// Finds the edge at groups of samples (lattices, or points); all groups are of one cloud and one pile.
class CloudEvaluation {
 public:
  CloudEvaluation(const CloudModel& model, const PuffUnion& pile) : model_(model), pile_(pile) {}

  // `positions` has those of `groups` groups of one size, one after the other. noise(k, wanted, values)
  // writes octave k of the groups that are wanted.
  template <typename Noise>
  std::vector<CloudEdge> operator()(std::span<const Vec<3>> positions, std::size_t groups,
                                    const Noise& noise) const {
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
  template <typename Noise>
  void displace(std::size_t k, const Noise& noise, std::vector<Surface>& surfaces) const {
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

class CloudField final : public Field<3> {
 public:
  explicit CloudField(CloudModel model) : model_(std::move(model)) {}

  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(model_, model_.with_neighbours(box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    const auto noise = [&](std::size_t k, std::span<const std::size_t>, std::span<float> values) {
      model_.octaves[k].noise->evaluate(points, {values, {}});
    };
    for (const CloudEdge& edge : CloudEvaluation(model_, model_.pile)(points.positions, 1, noise)) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        samples.values[i] = density(smoothstep(0.5f + edge.level[i] / edge.width[i]), edge.within[i]);
      }
    }
  }
  bool empty(const Box<3>& box) const override {
    const Box<3> own = model_.to_cloud(model_.with_neighbours(box));
    const double reach = model_.outward.front();
    return -own.upper.y > reach || model_.pile.lower_bound(own) > reach;
  }

 private:
  class Block final : public FieldBlock<3> {
   public:
    // `box` is that of the samples and of their neighbours.
    Block(const CloudModel& model, const Box<3>& box)
        : model_(model), pile_(model.pile.within(model.to_cloud(box))) {
      for (const Octave& octave : model_.octaves) noises_.push_back(octave.noise->block(box));
    }

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      evaluate_all({&lattice, 1}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      if (lattices.empty()) return;
      const glm::ivec3 count = lattices.front().count;
      std::vector<Lattice<3>> wider(lattices.begin(), lattices.end());
      for (Lattice<3>& lattice : wider) {
        lattice.first -= 1;
        lattice.count += 2;
      }
      const auto noise = [&](std::size_t k, std::span<const std::size_t> wanted, std::span<float> values) {
        std::vector<Lattice<3>> of_wanted;
        for (const std::size_t i : wanted) of_wanted.push_back(wider[i]);
        noises_[k]->evaluate_all(of_wanted, {values, {}});
      };
      std::span<float> values = samples.values;
      for (const CloudEdge& edge : CloudEvaluation(model_, pile_)(positions_of(wider), wider.size(), noise)) {
        const std::span<float> own = values.first(lattices.front().size());
        edge_cover(count, edge.level, edge.width, own);
        apply_core(edge.within, count, own);
        values = values.subspan(own.size());
      }
    }

   private:
    // Makes densities of covers; `within` has one sample more all around.
    static void apply_core(const std::vector<float>& within, const glm::ivec3& count,
                           std::span<float> covers) {
      auto value = covers.begin();
      for (int i = 1; i <= count.x; ++i) {
        for (int j = 1; j <= count.y; ++j) {
          auto from = within.begin() + (i * (count.y + 2) + j) * (count.z + 2) + 1;
          for (int k = 0; k < count.z; ++k, ++value, ++from) *value = density(*value, *from);
        }
      }
    }

    const CloudModel& model_;
    PuffUnion pile_;
    std::vector<std::unique_ptr<FieldBlock<3>>> noises_;
  };

  CloudModel model_;
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

FieldPtr make_cloud_field(const CloudParts& parts) {
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
  return std::make_shared<CloudField>(std::move(model));
}

}  // namespace solidnoise
