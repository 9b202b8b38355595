#include "solidnoise/noise/point/point_convolution.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "solidnoise/core/points.h"
#include "solidnoise/noise/convolution/impulse_process.h"
#include "solidnoise/noise/convolution/kernel_cells.h"
#include "solidnoise/noise/point/lane_polynomials.h"
#include "solidnoise/noise/point/point_cluster.h"
#include "solidnoise/noise/point/point_tile.h"
#include "solidnoise/noise/point/scale_fade.h"
#include "solidnoise/noise/point/tiled_sum.h"

namespace solidnoise {
namespace {

// Streams of the grids: one per level.
constexpr std::uint64_t kLevelStream = 1u << 20;

// Points that are prepared together.
constexpr std::size_t kBatch = 4096;

}  // namespace

double layer_window(double u) {
  const double inside = std::fmax(0.0, 1.0 - u * u);
  return inside * inside;
}

double layer_window_moment(int power) {
  // The integral of (1 - u^2)^m is 2 (2/3) (4/5) ... (2 m / (2 m + 1)).
  double integral = 2.0;
  for (int k = 1; k <= 2 * power; ++k) integral *= 2.0 * k / (2.0 * k + 1.0);
  return integral;
}

template <int Dim>
PointConvolution<Dim>::PointConvolution(const Settings& settings) : settings_(settings) {
  power_ = settings.count.mean;
  if (settings.side > 0.0) {
    power_ /= std::pow(settings.side, Dim);
  } else {
    const ScaleFade fade(Dim);
    power_ *= fade.second_moment / (1.0 - fade.lowest);
  }
  process_.emplace(std::array<CellAxis, Dim>{}, settings.count, 0);
}

template <int Dim>
ImpulseProcess<Dim> PointConvolution<Dim>::grid(int level, double cell_size) const {
  std::array<CellAxis, Dim> axes;
  axes.fill(CellAxis(cell_size));
  const std::uint64_t stream = kLevelStream + static_cast<std::uint64_t>(static_cast<std::int64_t>(level));
  return process_->with(axes, derive_seed(derive_seed(settings_.seed, kImpulseStream), stream));
}

// One call of evaluate().
template <int Dim>
class PointConvolution<Dim>::Evaluation {
 public:
  Evaluation(const PointConvolution& noise, const Points<Dim>& points, const Prepare& prepare,
             const Samples<Dim>& samples)
      : noise_(noise), points_(points), prepare_(prepare), samples_(samples), extent_(noise.settings_.layer) {
    const Settings& settings = noise.settings_;
    extent_.span = static_cast<float>(noise.process_->span());
    kernel_.dimensions = Dim;
    kernel_.layer = settings.layer > 0.0;
    kernel_.oriented = settings.waves == GaborWaves::oriented;
    kernel_.fade = extent_.fade = settings.side == 0.0;
  }

  void run() {
    const std::vector<std::size_t> order = spatial_order(points_);
    for (std::size_t first = 0; first < order.size(); first += kBatch) {
      evaluate_batch(std::span(order).subspan(first, std::min(kBatch, order.size() - first)));
    }
  }

 private:
  using Located = LocatedPoint<Dim>;

  // A grid and the points of the batch that use it (of a hierarchy the next coarser one too), those whose
  // polynomials are in powers apart from the others.
  struct Level {
    std::optional<ImpulseProcess<Dim>> process;
    std::array<std::vector<Located>, 2> points;
  };

  void evaluate_batch(std::span<const std::size_t> batch) {
    batch_ = batch;
    prepared_.resize(batch.size());
    prepare_(batch, prepared_);
    // Far-apart memory is read in a loop of its own: the processor then waits for many places at once.
    for (auto& coordinates : positions_) coordinates.resize(batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Vec<Dim>& position = points_.positions[batch[i]];
      for (int axis = 0; axis < Dim; ++axis) positions_[static_cast<std::size_t>(axis)][i] = position[axis];
    }
    const SampleBuffer<Dim> sums(samples_.subspan(0, batch.size()));
    fill_with_zero(sums.samples());
    for (std::size_t i = 0; i < batch.size(); ++i) add_to_level(static_cast<std::uint32_t>(i));
    for (auto& [l, level] : levels_) {
      for (const bool power : {false, true}) {
        auto& points = level.points[power ? 1 : 0];
        if (points.empty()) continue;
        level_ = &level;
        const double size = cell_of(level);
        coarse_ = extent_.fade ? &*this->level(l + 1, 2.0 * size).process : nullptr;
        power_ = power;
        tiles_.add(points, size, sums.samples());
        points.clear();
      }
    }
    scatter(sums.samples(), batch, samples_);
  }

  Level& level(int l, double size) {
    Level& found = levels_[l];
    if (!found.process) found.process = noise_.grid(l, size);
    return found;
  }
  static double cell_of(const Level& level) { return level.process->axes()[0].size(); }

  void add_to_level(std::uint32_t point) {
    // Most often the level is that of the point before.
    const double scale = prepared_[point].scale;
    if (!extent_.fade) {
      if (!fine_) fine_ = &level(0, noise_.settings_.side);
    } else if (!(scale >= size_ && scale < 2.0 * size_)) {
      const int l = std::ilogb(scale / noise_.settings_.unit);
      size_ = std::ldexp(noise_.settings_.unit, l);
      fine_ = &level(l, size_);
    }
    Located located;
    const double size = cell_of(*fine_);
    located.density = 1.0f;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const CellPosition position =
          locate_point(fine_->process->axes()[a], positions_[a][point], batch_[point]);
      located.cell[axis] = position.cell;
      located.fraction[a] = position.fraction;
      located.density *= static_cast<float>(scale / size);
    }
    located.radius = static_cast<float>(prepared_[point].radius / size);
    located.height = located.radius * extent_.layer * static_cast<float>(prepared_[point].flatness);
    located.weight = static_cast<float>(prepared_[point].amplitude);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      located.normal[axis] = static_cast<float>(prepared_[point].normal[axis]);
    }
    located.point = point;
    fine_->points[prepared_[point].kernel.power() ? 1 : 0].push_back(located);
  }

  // The impulses that the points of a tile need, from one grid or, of a hierarchy, from two:
  // stratum by stratum in lexicographic order, the finer grid first. Positions and turns in cells of the
  // finer grid.
  void gather(const PointTile<Dim>& tile, const PointCull& cull, ImpulseList& impulses) {
    const auto gather_from = [&](const ImpulseProcess<Dim>& process, const Index<Dim>& anchor,
                                 const PointCull& of_cells, const Scale& scale) {
      const ImpulseReach<Dim> reach = reach_of(anchor, of_cells, scale);
      for_each_reaching_row<Dim>(of_cells, [&](const Index<Dim>& first, const Index<Dim>& last) {
        process.generate(anchor + first, anchor + last, reach,
                         [&](const FoundImpulse& impulse) { append(impulse, scale, impulses); });
      });
    };
    const Index<Dim>& anchor = tile.anchor;
    Scale scale;
    gather_from(*level_->process, anchor, cull, scale);
    if (coarse_ == nullptr) return;
    for (int axis = 0; axis < Dim; ++axis) {
      scale.offset[role_of_axis<Dim>(axis)] = static_cast<float>(anchor[axis] & 1);
    }
    scale.size = 2.0f;
    scale.turn = 1.0f / static_cast<float>(1 << Dim);
    gather_from(*coarse_, anchor >> std::int64_t{1}, coarsened(cull, scale.offset), scale);
  }

  static constexpr float kLowest = 1.0f / static_cast<float>(1 << Dim);  // turn

  // A grid as the finer one sees it.
  struct Scale {
    float size = 1.0f;                   // of a cell
    std::array<float, kRoles> offset{};  // from the corner of its anchor to the tile's anchor
    // With the radius r in cells of the finer grid, the y of an impulse is r^n times its turn: of a coarser
    // one it is (r / 2)^n times what it carries.
    float turn = 1.0f;
  };

  // Where impulses are in reach, in strata, and which shares are in turn.
  ImpulseReach<Dim> reach_of(const Index<Dim>& anchor, const PointCull& cull, const Scale& scale) const {
    ImpulseReach<Dim> reach = solidnoise::reach_of<Dim>(anchor, cull);
    const auto share_of_turn = [&](float turn) {
      const double share = (static_cast<double>(turn / scale.turn) - kLowest) / (1.0 - kLowest);
      return static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(kShareMask));
    };
    reach.least_share = share_of_turn(cull.least_turn);
    reach.most_share = share_of_turn(cull.most_turn);
    return reach;
  }

  // Appends an impulse, whose position is from the anchor of its grid.
  void append(const FoundImpulse& impulse, const Scale& scale, ImpulseList& impulses) const {
    const std::size_t end = impulses.size();
    impulses.reserve(end + 1);
    for (int axis = 0; axis < Dim; ++axis) {
      const Role role = role_of_axis<Dim>(axis);
      const float place =
          static_cast<float>(impulse.position(axis)) / static_cast<float>(CellAxis::kQuantaPerCell);
      impulses.position(role)[end] = scale.size * place - scale.offset[role];
    }
    float weight = 2.0f * static_cast<float>(impulse.mark >> 63) - 1.0f;
    if (noise_.settings_.factor) weight *= static_cast<float>(noise_.settings_.factor(impulse.mark));
    impulses.attribute(kWeight)[end] = weight;
    const auto share = static_cast<float>(share_of(impulse.mark));
    impulses.attribute(kTurn)[end] = scale.turn * (kLowest + (1.0f - kLowest) * share);
    impulses.set_size(end + 1);
  }

  void sum(std::span<const Located> points, PointCluster& cluster, ImpulseList& impulses, ClusterSums& sums) {
    std::array<const KernelFamily::Member*, PointCluster::kSamples> kernels;
    for (std::size_t i = 0; i < points.size(); ++i) kernels[i] = &prepared_[points[i].point].kernel;
    const PointPolynomials& polynomials = polynomials_.fill(std::span(kernels).first(points.size()), power_);
    for (std::size_t lane = 0; kernel_.oriented && lane < PointCluster::kSamples; ++lane) {
      const auto& wave = prepared_[points[std::min(lane, points.size() - 1)].point].wave;
      for (int axis = 0; axis < Dim; ++axis) {
        cluster.wave[role_of_axis<Dim>(axis)][lane] =
            static_cast<float>(wave[static_cast<std::size_t>(axis)] * cell_of(*level_));
      }
    }
    sum_impulses(kernel_, cluster, polynomials, impulses, sums);
  }

  const PointConvolution& noise_;
  const Points<Dim>& points_;
  const Prepare& prepare_;
  Samples<Dim> samples_;
  KernelExtent extent_;
  PointKernel kernel_;
  std::map<int, Level> levels_;  // by the exponent of the cell size
  double size_ = 0.0;            // of the cells of the finer of two levels, that used last
  Level* fine_ = nullptr;
  std::span<const std::size_t> batch_;
  std::vector<KernelPoint<Dim>> prepared_;
  std::array<std::vector<double>, Dim> positions_;
  Level* level_ = nullptr;                       // whose points are evaluated
  const ImpulseProcess<Dim>* coarse_ = nullptr;  // that the same points use too
  bool power_ = false;                           // whether their polynomials are in powers
  LanePolynomials polynomials_;
  TiledSum<Dim, Evaluation> tiles_{*this, extent_, 2};
  friend TiledSum<Dim, Evaluation>;
};

template <int Dim>
void PointConvolution<Dim>::evaluate(const Points<Dim>& points, const Prepare& prepare,
                                     const Samples<Dim>& samples) const {
  require_room(samples, points.size());
  Evaluation(*this, points, prepare, samples).run();
}

template class PointConvolution<3>;
template class PointConvolution<4>;

}  // namespace solidnoise
