#include "solidnoise/field/shared_field.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace solidnoise {
namespace {

bool same(const Lattice<3>& a, const Lattice<3>& b) {
  return a.origin == b.origin && a.step == b.step && a.first == b.first && a.count == b.count;
}

// The block of a box, and the values (without gradients) that it was last asked for.
class KeptBlock {
 public:
  KeptBlock(const Box<3>& box, std::unique_ptr<FieldBlock<3>> block) : box_(box), block_(std::move(block)) {}

  bool is_of(const Box<3>& box) const { return box.lower == box_.lower && box.upper == box_.upper; }

  void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) {
    if (samples.wants_gradient()) return block_->evaluate_all(lattices, samples);
    if (values_.size() != samples.values.size() || !std::ranges::equal(lattices, lattices_, same)) {
      lattices_.clear();  // until there are values
      values_.resize(samples.values.size());
      block_->evaluate_all(lattices, {values_, {}});
      lattices_.assign(lattices.begin(), lattices.end());
    }
    std::ranges::copy(values_, samples.values.begin());
  }

 private:
  Box<3> box_;
  std::unique_ptr<FieldBlock<3>> block_;
  std::vector<Lattice<3>> lattices_;
  std::vector<float> values_;
};

// The points that a field was last asked for at, and its values there.
class KeptPoints {
 public:
  bool are(const Points<3>& points) const {
    const auto same = [](const auto& a, const auto& b) {
      return std::equal(a.begin(), a.end(), b.begin(), b.end());
    };
    return same(points.positions, positions_) && same(points.normals, normals_) &&
           same(points.vertices, vertices_);
  }
  std::span<const float> values() const { return values_; }

  void keep(const Points<3>& points, std::span<const float> values) {
    positions_.assign(points.positions.begin(), points.positions.end());
    normals_.assign(points.normals.begin(), points.normals.end());
    vertices_.assign(points.vertices.begin(), points.vertices.end());
    values_.assign(values.begin(), values.end());
  }

 private:
  std::vector<Vec<3>> positions_, normals_;
  std::vector<std::uint32_t> vertices_;
  std::vector<float> values_;
};

class SharedField final : public Field<3> {
 public:
  explicit SharedField(FieldPtr field) : field_(std::move(field)) {}

  int channels() const override { return field_->channels(); }
  bool has_gradient() const override { return field_->has_gradient(); }
  std::unique_ptr<FieldBlock<3>> block(const Box<3>& box) const override {
    return std::make_unique<Block>(kept(box));
  }
  void evaluate(const Points<3>& points, const Samples<3>& samples) const override {
    if (samples.wants_gradient()) return field_->evaluate(points, samples);
    KeptPoints& kept = of_thread().points;
    if (kept.values().size() == samples.values.size() && kept.are(points)) {
      std::ranges::copy(kept.values(), samples.values.begin());
    } else {
      field_->evaluate(points, samples);  // which may come back here, in the same thread
      kept.keep(points, samples.values);
    }
  }
  bool empty(const Box<3>& box) const override { return field_->empty(box); }
  std::optional<Statistics> statistics() const override { return field_->statistics(); }

 private:
  class Block final : public FieldBlock<3> {
   public:
    explicit Block(std::shared_ptr<KeptBlock> kept) : kept_(std::move(kept)) {}

    void evaluate(const Lattice<3>& lattice, const Samples<3>& samples) const override {
      kept_->evaluate_all({&lattice, 1}, samples);
    }
    void evaluate_all(std::span<const Lattice<3>> lattices, const Samples<3>& samples) const override {
      kept_->evaluate_all(lattices, samples);
    }

   private:
    std::shared_ptr<KeptBlock> kept_;
  };

  struct Kept {
    std::weak_ptr<KeptBlock> block;  // alive while one that uses it is
    KeptPoints points;
  };

  Kept& of_thread() const {
    const std::lock_guard lock(mutex_);
    return kept_[std::this_thread::get_id()];
  }

  // The thread's own block of the box.
  std::shared_ptr<KeptBlock> kept(const Box<3>& box) const {
    std::weak_ptr<KeptBlock>& last = of_thread().block;
    std::shared_ptr<KeptBlock> block = last.lock();
    if (!block || !block->is_of(box)) {
      block = std::make_shared<KeptBlock>(box, field_->block(box));
      last = block;
    }
    return block;
  }

  FieldPtr field_;
  mutable std::mutex mutex_;
  mutable std::map<std::thread::id, Kept> kept_;
};

}  // namespace

FieldPtr share(FieldPtr field) {
  return std::make_shared<SharedField>(std::move(field));
}

}  // namespace solidnoise
