#include "solidnoise/noise/point_convolution.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "solidnoise/core/special_functions.h"
#include "solidnoise/noise/impulse_cells.h"
#include "solidnoise/noise/kernel_cells.h"
#include "solidnoise/noise/point_cluster.h"
#include "solidnoise/noise/point_order.h"

namespace solidnoise {
namespace {

// Streams of the grids: one per level.
constexpr std::uint64_t kLevelStream = 1u << 20;

// Points that are prepared together, and that share a gathering of impulses.
constexpr std::size_t kBatch = 4096;
constexpr std::size_t kTilePoints = 128;
constexpr std::int64_t kTileCells = 3;  // most cells along an axis that the points of a tile lie in

}  // namespace

double layer_window(double u) {
  const double inside = std::fmax(0.0, 1.0 - u * u);
  return inside * inside;
}

double layer_window_moment(int power) {
  return std::beta(0.5, 2.0 * power + 1.0);
}

template <int Dim>
PointConvolution<Dim>::PointConvolution(const Settings& settings) : settings_(settings) {
  const double support =
      settings.layer > 0.0 ? 2.0 * std::numbers::pi * settings.layer : unit_ball_volume(Dim);
  density_ = settings.impulses / support;
  power_ = density_;
  if (settings.radius == 0.0 && settings.transition == ScaleTransition::fade) {
    const ScaleFade fade(Dim);
    density_ *= fade.impulses_per_effective_one;
    power_ = density_ * fade.second_moment;
  }
}

template <int Dim>
double PointConvolution<Dim>::reach() const {
  return std::hypot(1.0, settings_.layer);
}

// One call of evaluate().
template <int Dim>
class PointConvolution<Dim>::Evaluation {
 public:
  Evaluation(const PointConvolution& noise, const Points<Dim>& points, const Prepare& prepare,
             std::span<float> values)
      : noise_(noise), points_(points), prepare_(prepare), values_(values) {
    const Settings& settings = noise.settings_;
    fixed_ = settings.radius > 0.0;
    kernel_.dimensions = Dim;
    kernel_.layer = settings.layer > 0.0;
    kernel_.oriented = settings.waves == GaborWaves::oriented;
    kernel_.fade = !fixed_ && settings.transition == ScaleTransition::fade;
  }

  void run() {
    const std::vector<std::size_t> order = spatial_order(points_);
    for (std::size_t first = 0; first < order.size(); first += kBatch) {
      evaluate_batch(std::span(order).subspan(first, std::min(kBatch, order.size() - first)));
    }
  }

 private:
  // A point as one grid sees it.
  struct Located {
    Index<Dim> cell;
    std::array<float, Dim> fraction;
    float radius;   // in cells
    float density;  // (r / 2^l)^n
    float weight;
    std::uint32_t point;  // in the batch
  };

  // A grid and the points of the batch that use it, those whose polynomials are in powers apart from the
  // others.
  struct Level {
    std::unique_ptr<ImpulseCells<Dim>> cells;
    std::array<std::vector<Located>, 2> points;
  };

  void evaluate_batch(std::span<const std::size_t> batch) {
    prepared_.resize(batch.size());
    for (std::size_t i = 0; i < batch.size(); ++i) {
      prepare_(batch[i], prepared_[i]);
      values_[batch[i]] = 0.0f;
      add_to_levels(batch[i], static_cast<std::uint32_t>(i));
    }
    batch_ = batch;
    for (auto& [key, level] : levels_) {
      for (int form = 0; form < 2; ++form) {
        auto& points = level.points[static_cast<std::size_t>(form)];
        evaluate_level(*level.cells, points, form == 1);
        points.clear();
      }
    }
  }

  Level& level(int l, double size) {
    Level& found = levels_[l];
    if (!found.cells) {
      const Settings& settings = noise_.settings_;
      std::array<CellAxis, Dim> axes;
      axes.fill(CellAxis(size));
      double mean = noise_.density_;
      if (kernel_.fade) mean *= 1.0 - std::exp2(-Dim);
      if (fixed_) mean *= std::pow(size / settings.radius, Dim);
      const std::uint64_t key =
          derive_seed(derive_seed(settings.seed, kImpulseStream),
                      kLevelStream + static_cast<std::uint64_t>(static_cast<std::int64_t>(l)));
      found.cells = std::make_unique<ImpulseCells<Dim>>(ImpulseProcess<Dim>(axes, mean, key));
    }
    return found;
  }

  void add_to_levels(std::size_t sample, std::uint32_t point) {
    const double radius = prepared_[point].radius;
    if (fixed_) {
      const double size = radius * noise_.reach();
      return add(level(0, size), sample, point, radius / size, 1.0);
    }
    const int fine = std::ilogb(radius);
    const double size = std::ldexp(1.0, fine);
    const ScaleWeights weights = scale_weights(noise_.settings_.transition, Dim, radius / size - 1.0);
    if (weights.fine != 0.0) add(level(fine, size), sample, point, radius / size, weights.fine);
    if (weights.coarse != 0.0) {
      add(level(fine + 1, 2.0 * size), sample, point, 0.5 * radius / size, weights.coarse);
    }
  }

  void add(Level& level, std::size_t sample, std::uint32_t point, double radius, double weight) {
    Located located;
    for (int axis = 0; axis < Dim; ++axis) {
      const CellPosition position = level.cells->axis().locate(points_.coordinate(sample, axis));
      located.cell[axis] = position.cell;
      located.fraction[static_cast<std::size_t>(axis)] = position.fraction;
    }
    located.radius = static_cast<float>(radius);
    located.density = static_cast<float>(std::pow(radius, Dim));
    located.weight = static_cast<float>(weight * prepared_[point].amplitude);
    located.point = point;
    level.points[prepared_[point].kernel.power() ? 1 : 0].push_back(located);
  }

  void evaluate_level(ImpulseCells<Dim>& cells, std::span<const Located> points, bool power) {
    while (!points.empty()) {
      const std::size_t count = tile_size(points);
      const std::span<const Located> tile = points.first(count);
      gather(cells, tile);
      for (std::size_t first = 0; first < count; first += PointCluster::kSamples) {
        const std::size_t in_cluster = std::min<std::size_t>(PointCluster::kSamples, count - first);
        evaluate_cluster(cells.axis().size(), tile.subspan(first, in_cluster), power);
      }
      points = points.subspan(count);
    }
  }

  // How many of the first points are near enough to each other.
  static std::size_t tile_size(std::span<const Located> points) {
    Index<Dim> lower = points.front().cell;
    Index<Dim> upper = lower;
    std::size_t count = 1;
    for (; count < std::min(points.size(), kTilePoints); ++count) {
      for (int axis = 0; axis < Dim; ++axis) {
        lower[axis] = std::min(lower[axis], points[count].cell[axis]);
        upper[axis] = std::max(upper[axis], points[count].cell[axis]);
        if (upper[axis] - lower[axis] >= kTileCells) return count;
      }
    }
    return count;
  }

  // Sets where the impulses of some points may be. Positions are from the corner of the cell `anchor_`.
  PointCull bounds(std::span<const Located> points) const {
    PointCull cull;
    cull.dimensions = Dim;
    cull.lower.fill(HUGE_VALF);
    cull.upper.fill(-HUGE_VALF);
    float largest = 0.0f;
    float least_density = HUGE_VALF, most_density = 0.0f;
    for (const Located& point : points) {
      for (int axis = 0; axis < Dim; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const float x = from_anchor(point, axis);
        cull.lower[a] = std::min(cull.lower[a], x);
        cull.upper[a] = std::max(cull.upper[a], x);
      }
      largest = std::max(largest, point.radius);
      least_density = std::min(least_density, point.density);
      most_density = std::max(most_density, point.density);
    }
    cull.reach = largest * static_cast<float>(noise_.reach());
    if (kernel_.fade) {
      // fade(y) is 0 outside of 2^-n < y < 1; a small margin for rounding.
      cull.least_turn = 0.9999f * std::exp2(static_cast<float>(-Dim)) / most_density;
      cull.most_turn = 1.0001f / least_density;
    }
    cull.below = 0.0f;
    cull.above = 0.0f;
    if (kernel_.layer) bound_layer(points, cull);
    return cull;
  }

  // With m the mean normal, an impulse at X within the layer of a point x of normal n is within
  //   |m.(X - x)| <= |n.(X - x)| + |m - n| |X - x| <= layer + |m - n| reach.
  void bound_layer(std::span<const Located> points, PointCull& cull) const {
    std::array<double, 3> mean{};
    for (const Located& point : points) {
      for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += prepared_[point.point].normal[axis];
    }
    const double length = std::hypot(mean[0], mean[1], mean[2]);
    if (length < 0.5 * static_cast<double>(points.size())) return;
    for (std::size_t axis = 0; axis < 3; ++axis) cull.normal[axis] = static_cast<float>(mean[axis] / length);
    cull.below = HUGE_VALF;
    cull.above = -HUGE_VALF;
    constexpr float kMargin = 1e-4f;
    for (const Located& point : points) {
      float along = 0.0f;
      float square = 0.0f;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        along += cull.normal[a] * from_anchor(point, axis);
        const float difference = cull.normal[a] - static_cast<float>(prepared_[point.point].normal[a]);
        square += difference * difference;
      }
      const float half =
          point.radius * static_cast<float>(noise_.settings_.layer) + std::sqrt(square) * cull.reach;
      cull.below = std::min(cull.below, along - half - kMargin);
      cull.above = std::max(cull.above, along + half + kMargin);
    }
  }

  float from_anchor(const Located& point, int axis) const {
    return static_cast<float>(point.cell[axis] - anchor_[axis]) +
           point.fraction[static_cast<std::size_t>(axis)];
  }

  // Collects the impulses of a tile, cell by cell in lexicographic order.
  void gather(ImpulseCells<Dim>& cells, std::span<const Located> tile) {
    anchor_ = tile.front().cell;
    const PointCull cull = bounds(tile);
    gathered_.clear();
    Index<Dim> first, last;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      first[axis] = static_cast<std::int64_t>(std::floor(cull.lower[a] - cull.reach));
      last[axis] = static_cast<std::int64_t>(std::floor(cull.upper[a] + cull.reach));
    }
    Index<Dim> cell = first;
    while (true) {
      if (reaches(cull, cell)) append(cells.at(anchor_ + cell), cell, cull);
      int axis = Dim - 1;
      while (axis >= 0 && ++cell[axis] > last[axis]) {
        cell[axis] = first[axis];
        --axis;
      }
      if (axis < 0) return;
    }
  }

  // Whether a cell may hold impulses of interest.
  static bool reaches(const PointCull& cull, const Index<Dim>& cell) {
    float square = 0.0f;
    float along = 0.0f;
    float half = 0.0f;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const auto lower = static_cast<float>(cell[axis]);
      const float excess = std::max({lower - cull.upper[a], cull.lower[a] - lower - 1.0f, 0.0f});
      square += excess * excess;
      if (axis < 3) {
        along += cull.normal[a] * (lower + 0.5f);
        half += 0.5f * std::abs(cull.normal[a]);
      }
    }
    return square <= cull.reach * cull.reach * 1.0001f && along + half >= cull.below &&
           along - half <= cull.above;
  }

  void append(const std::vector<typename ImpulseCells<Dim>::Item>& items, const Index<Dim>& cell,
              const PointCull& cull) {
    constexpr float kLowest = 1.0f / static_cast<float>(1 << Dim);
    gathered_.reserve(gathered_.size() + items.size());
    std::size_t end = gathered_.size();
    for (const auto& item : items) {
      const float turn = kLowest + (1.0f - kLowest) * item.share;
      if (kernel_.fade && (turn < cull.least_turn || turn > cull.most_turn)) continue;
      for (int axis = 0; axis < Dim; ++axis) {
        gathered_.position(axis)[end] =
            static_cast<float>(cell[axis]) + item.position[static_cast<std::size_t>(axis)];
      }
      gathered_.weight()[end] = item.weight;
      gathered_.turn()[end] = turn;
      ++end;
    }
    gathered_.set_size(end);
  }

  void evaluate_cluster(double cell_size, std::span<const Located> points, bool power) {
    PointCull cull = bounds(points);
    if (!kernel_.fade) cull.most_turn = 2.0f;
    kept_.clear();
    cull_impulses(gathered_, cull, kept_);

    cluster_.count = static_cast<int>(points.size());
    polynomials_.degree = power ? 4 : 0;
    for (const Located& point : points) {
      polynomials_.degree = std::max(polynomials_.degree, prepared_[point.point].kernel.degree());
    }
    if (power) polynomials_.degree = polynomials_.degree <= 4 ? 4 : polynomials_.degree <= 8 ? 8 : 12;
    polynomials_.power = power;
    const std::size_t needed = static_cast<std::size_t>(polynomials_.degree + 1) * PointCluster::kSamples;
    if (coefficients_.size() < needed + 16) coefficients_.resize(needed + 16);
    float* const coefficients = aligned(coefficients_.data());
    polynomials_.coefficients = coefficients;

    for (std::size_t lane = 0; lane < PointCluster::kSamples; ++lane) {
      const Located& point = points[std::min(lane, points.size() - 1)];
      fill_lane(cell_size, point, lane);
      fill_polynomial(prepared_[point.point].kernel, power, coefficients + lane);
    }
    alignas(64) float sums[PointCluster::kSamples];
    sum_impulses(kernel_, cluster_, polynomials_, kept_, sums);
    for (std::size_t i = 0; i < points.size(); ++i) {
      values_[batch_[points[i].point]] += points[i].weight * sums[i];
    }
  }

  void fill_lane(double cell_size, const Located& point, std::size_t lane) {
    const KernelPoint<Dim>& prepared = prepared_[point.point];
    for (int axis = 0; axis < Dim; ++axis) {
      cluster_.coordinate[axis][lane] = from_anchor(point, axis);
      cluster_.wave[axis][lane] =
          static_cast<float>(prepared.wave[static_cast<std::size_t>(axis)] * cell_size);
    }
    cluster_.density[lane] = point.density;
    cluster_.inverse_square_radius[lane] = 1.0f / (point.radius * point.radius);
    if (!kernel_.layer) return;
    const float height = point.radius * static_cast<float>(noise_.settings_.layer);
    cluster_.inverse_square_height[lane] = 1.0f / (height * height);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cluster_.normal[axis][lane] = static_cast<float>(prepared.normal[axis]);
    }
  }

  // One lane's coefficients, kSamples apart.
  void fill_polynomial(const KernelFamily::Member& kernel, bool power, float* to) const {
    const std::vector<float>& lower = power ? kernel.lower->coefficients : kernel.lower->chebyshev;
    const std::vector<float>& upper = power ? kernel.upper->coefficients : kernel.upper->chebyshev;
    const float blend = static_cast<float>(kernel.blend);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(polynomials_.degree); ++k) {
      const float a = k < lower.size() ? lower[k] : 0.0f;
      const float b = k < upper.size() ? upper[k] : 0.0f;
      to[k * PointCluster::kSamples] = (1.0f - blend) * a + blend * b;
    }
  }

  static float* aligned(float* memory) {
    const auto address = reinterpret_cast<std::uintptr_t>(memory);
    return memory + (64 - address % 64) % 64 / sizeof(float);
  }

  const PointConvolution& noise_;
  const Points<Dim>& points_;
  const Prepare& prepare_;
  std::span<float> values_;
  bool fixed_ = false;
  PointKernel kernel_;
  std::map<int, Level> levels_;
  std::span<const std::size_t> batch_;
  std::vector<KernelPoint<Dim>> prepared_;
  Index<Dim> anchor_{0};
  PointImpulses gathered_;
  PointImpulses kept_;
  PointCluster cluster_;
  PointPolynomials polynomials_;
  std::vector<float> coefficients_;
};

template <int Dim>
void PointConvolution<Dim>::evaluate(const Points<Dim>& points, const Prepare& prepare,
                                     std::span<float> values) const {
  Evaluation(*this, points, prepare, values).run();
}

template class PointConvolution<2>;
template class PointConvolution<3>;
template class PointConvolution<4>;

}  // namespace solidnoise
