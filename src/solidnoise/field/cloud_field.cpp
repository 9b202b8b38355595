#include "solidnoise/field/cloud_field.h"

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "solidnoise/field/cloud_edge.h"
#include "solidnoise/field/edge_cover.h"
#include "solidnoise/field/shaping.h"

namespace solidnoise {
namespace {

// Densities below this are taken for nothing: what cannot be seen needs no voxels.
constexpr float kLeastDensity = 1e-3f;

float density(float cover, float within) {
  const float result = cover * within;
  return result < kLeastDensity ? 0.0f : result;
}

class CloudField final : public Field<3> {
 public:
  explicit CloudField(CloudModel model) : model_(std::move(model)) {}

  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(model_, model_.with_neighbours(box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    require_room(samples, points.size());
    const auto noise = [&](std::size_t k, std::span<const std::size_t>, std::span<float> values) {
      model_.octaves[k].noise->evaluate(points, {values, {}});
    };
    for (const CloudEdge& edge : cloud_edges(model_, model_.pile, points.positions, 1, noise)) {
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
      require_room(samples, lattices.size() * lattices.front().size());
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
      for (const CloudEdge& edge : cloud_edges(model_, pile_, positions_of(wider), wider.size(), noise)) {
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

}  // namespace

FieldPtr make_cloud_field(const CloudParts& parts) {
  return std::make_shared<CloudField>(make_cloud_model(parts));
}

}  // namespace solidnoise
