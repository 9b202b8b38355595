#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "solidnoise/noise/convolution/sparse_convolution.h"
#include "solidnoise/noise/convolution/sparse_convolution_source.h"

namespace solidnoise {
namespace {

// One axis of a lattice, located in the cells.
class LocatedAxis {
 public:
  // Of the axis' samples. Impulses reach `reach` cells.
  template <int Dim>
  void locate(const Lattice<Dim>& lattice, const CellAxis& cells, int axis, std::int64_t reach) {
    const Key key{lattice.origin[axis], lattice.step[axis], lattice.first[axis], lattice.count[axis]};
    if (key == key_) return;
    key_ = key;
    positions_.clear();
    for (int i = 0; i < lattice.count[axis]; ++i) {
      positions_.push_back(cells.locate(lattice.coordinate(axis, i)));
    }
    const double span = std::min(CellAxis::kMaxSpan, CellAxis::kExact - static_cast<double>(reach));
    const double most = span * cells.size() / lattice.step[axis];
    brick_side_ = most >= SampleBrick::kSide ? SampleBrick::kSide : std::max(1, static_cast<int>(most));
  }

  const CellPosition* positions() const { return positions_.data(); }
  int brick_side() const { return brick_side_; }  // samples of one brick

 private:
  struct Key {
    double origin = 0.0;
    double step = 0.0;
    std::int64_t first = 0;
    int count = 0;

    bool operator==(const Key&) const = default;
  };

  Key key_;  // of what is located
  std::vector<CellPosition> positions_;
  int brick_side_ = 1;
};

}  // namespace

template <int Dim>
class SparseConvolution<Dim>::Block final : public FieldBlock<Dim> {
 public:
  Block(const SparseConvolution& noise, const Box<Dim>& box) : noise_(noise) {
    Neighbourhood neighbourhood;
    for (int axis = 0; axis < Dim; ++axis) {
      const Role role = role_of_axis<Dim>(axis);
      const CellPosition lower = noise_.process_.axes()[axis].locate(box.lower[axis]);
      const CellPosition upper = noise_.process_.axes()[axis].locate(box.upper[axis]);
      neighbourhood.first[axis] = lower.cell;
      neighbourhood.last[axis] = upper.cell;
      neighbourhood.lower[role] = from_anchor(lower, lower.cell);
      neighbourhood.upper[role] = from_anchor(upper, lower.cell);
    }
    const ImpulseReach<Dim> reach = noise_.reach_of(neighbourhood);
    bool fits = reach.cells() * std::max(noise_.process_.mean_per_cell(), 1.0) <= kMostImpulsesInBlock;
    for (int axis = 0; axis < Dim; ++axis) {
      fits = fits && reach.last[axis] - reach.first[axis] < ImpulseBlock<Dim>::kMaxCellsPerAxis;
    }
    if (fits) source_.emplace(noise_.process_, *noise_.kernel_, reach);
  }

  void evaluate(const Lattice<Dim>& lattice, const Samples<Dim>& samples) const override {
    require_room(samples, lattice.size());
    for (int axis = 0; axis < Dim; ++axis) {
      axes_[axis].locate(lattice, noise_.process_.axes()[axis], axis, noise_.reach_[axis]);
    }
    glm::vec<Dim, int> start(0);
    while (true) {
      evaluate_brick(lattice, start, samples);
      int axis = Dim - 1;
      while (axis >= 0 && (start[axis] += side(axis)) >= lattice.count[axis]) start[axis--] = 0;
      if (axis < 0) return;
    }
  }

 private:
  // A brick has one sample in time.
  int side(int axis) const { return role_of_axis<Dim>(axis) == kT ? 1 : axes_[axis].brick_side(); }

  void evaluate_brick(const Lattice<Dim>& lattice, const glm::vec<Dim, int>& start,
                      const Samples<Dim>& samples) const {
    SampleBrick brick;
    Neighbourhood neighbourhood;
    for (int axis = 0; axis < Dim; ++axis) {
      const Role role = role_of_axis<Dim>(axis);
      const CellPosition* positions = axes_[axis].positions() + start[axis];
      const int count = std::min(side(axis), lattice.count[axis] - start[axis]);
      neighbourhood.first[axis] = positions[0].cell;
      neighbourhood.last[axis] = positions[count - 1].cell;
      neighbourhood.lower[role] = from_anchor(positions[0], positions[0].cell);
      neighbourhood.upper[role] = from_anchor(positions[count - 1], positions[0].cell);
      if (role == kT) {
        brick.time = neighbourhood.lower[role];
        continue;
      }
      brick.count[role] = count;
      for (int i = 0; i < SampleBrick::kSide; ++i) {
        brick.coordinate[role][i] = from_anchor(positions[std::min(i, count - 1)], positions[0].cell);
      }
    }

    std::optional<Source> local;
    if (!source_) local.emplace(noise_.process_, *noise_.kernel_, noise_.reach_of(neighbourhood));
    noise_.gather(source_ ? *source_ : *local, neighbourhood, list_);

    BrickSums sums;
    const bool gradient = samples.wants_gradient();
    noise_.kernel_->sum(list_, brick, derivatives_of(samples), sums);
    scatter(lattice, start, brick, sums.value, static_cast<float>(noise_.amplitude_), samples.values);
    for (int axis = 0; gradient && axis < Dim; ++axis) {
      scatter(lattice, start, brick, sums.gradient[role_of_axis<Dim>(axis)], noise_.slope_[axis],
              samples.gradient[axis]);
    }
  }

  // Writes a brick's sums, times `factor`, to where the lattice has these samples.
  static void scatter(const Lattice<Dim>& lattice, const glm::vec<Dim, int>& start, const SampleBrick& brick,
                      const float* sums, float factor, std::span<float> values) {
    std::array<std::ptrdiff_t, kRoles> stride{};
    std::ptrdiff_t offset = 0;
    std::ptrdiff_t axis_stride = 1;
    for (int axis = Dim - 1; axis >= 0; --axis) {
      stride[role_of_axis<Dim>(axis)] = axis_stride;
      offset += axis_stride * start[axis];
      axis_stride *= lattice.count[axis];
    }
    constexpr int kSide = SampleBrick::kSide;
    const bool in_lines = brick.count[kZ] == kSide && stride[kZ] == 1;
    for (int x = 0; x < brick.count[kX]; ++x) {
      for (int y = 0; y < brick.count[kY]; ++y) {
        float* const row = values.data() + offset + x * stride[kX] + y * stride[kY];
        const float* const sum = sums + (x * kSide + y) * kSide;
        if (in_lines) {
          for (int z = 0; z < kSide; ++z) row[z] = factor * sum[z];
        } else {
          for (int z = 0; z < brick.count[kZ]; ++z) row[z * stride[kZ]] = factor * sum[z];
        }
      }
    }
  }

  SparseConvolution noise_;
  std::optional<Source> source_;
  // Used again and again; a block belongs to one thread.
  mutable std::array<LocatedAxis, Dim> axes_;
  mutable ImpulseList list_{Dim};
};

// Of a noise that is 0.
template <int Dim>
class SilentBlock final : public FieldBlock<Dim> {
 public:
  void evaluate(const Lattice<Dim>&, const Samples<Dim>& samples) const override { fill_with_zero(samples); }
};

template <int Dim>
std::unique_ptr<FieldBlock<Dim>> SparseConvolution<Dim>::block(const Box<Dim>& box) const {
  if (!kernel_) return std::make_unique<SilentBlock<Dim>>();
  return std::make_unique<Block>(*this, box);
}

template std::unique_ptr<FieldBlock<1>> SparseConvolution<1>::block(const Box<1>&) const;
template std::unique_ptr<FieldBlock<2>> SparseConvolution<2>::block(const Box<2>&) const;
template std::unique_ptr<FieldBlock<3>> SparseConvolution<3>::block(const Box<3>&) const;
template std::unique_ptr<FieldBlock<4>> SparseConvolution<4>::block(const Box<4>&) const;

}  // namespace solidnoise
