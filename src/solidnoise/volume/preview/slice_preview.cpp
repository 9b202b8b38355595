#include "solidnoise/volume/preview/slice_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/core/random.h"
#include "solidnoise/volume/preview/preview_view.h"

namespace solidnoise {
namespace {

using Rgb = std::array<float, 3>;

constexpr int kLongestSide = 480;
constexpr int kStreak = 18;  // pixels, to each side

// The values of a grid in a slice of voxels.
class Slice {
 public:
  Slice(const openvdb::GridBase& grid, UpAxis up) : up_(up == UpAxis::y ? 1 : 2), depth_(3 - up_) {
    box_ = grid.evalActiveVoxelBoundingBox();
    if (box_.empty()) return;
    values_.resize(static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()));
    if (const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid)) {
      read(*floats, [](float value) { return openvdb::Vec3s(value); });
    } else {
      read(dynamic_cast<const openvdb::Vec3SGrid&>(grid), [](const openvdb::Vec3s& value) { return value; });
    }
  }

  bool empty() const { return values_.empty(); }
  int width() const { return box_.dim().x(); }
  int height() const { return box_.dim()[up_]; }
  int up_axis() const { return up_; }

  // At a place in voxels from the left and from below, each voxel's centre at a half. Between centres it is
  // linear, beyond the last ones constant.
  openvdb::Vec3s at(double x, double y) const {
    const double u = std::clamp(x - 0.5, 0.0, width() - 1.0);
    const double v = std::clamp(y - 0.5, 0.0, height() - 1.0);
    const int i = std::min(static_cast<int>(u), std::max(width() - 2, 0));
    const int j = std::min(static_cast<int>(v), std::max(height() - 2, 0));
    const auto s = static_cast<float>(u - i);
    const auto t = static_cast<float>(v - j);
    return (1.0f - t) * ((1.0f - s) * voxel(i, j) + s * voxel(i + 1, j)) +
           t * ((1.0f - s) * voxel(i, j + 1) + s * voxel(i + 1, j + 1));
  }

  // That of the voxel which the place is in.
  openvdb::Vec3s nearest(double x, double y) const { return voxel(static_cast<int>(x), static_cast<int>(y)); }

 private:
  template <typename Grid, typename ToVector>
  void read(const Grid& grid, const ToVector& to_vector) {
    const auto accessor = grid.getConstAccessor();
    openvdb::Coord place = box_.min();
    place[depth_] += box_.dim()[depth_] / 2;
    std::size_t next = 0;
    for (int j = 0; j < height(); ++j) {
      for (int i = 0; i < width(); ++i) {
        openvdb::Coord here = place;
        here.x() += i;
        here[up_] += j;
        values_[next++] = to_vector(accessor.getValue(here));
      }
    }
  }

  const openvdb::Vec3s& voxel(int i, int j) const {
    const int column = std::clamp(i, 0, width() - 1);
    const int row = std::clamp(j, 0, height() - 1);
    return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width()) +
                   static_cast<std::size_t>(column)];
  }

  int up_;
  int depth_;
  openvdb::CoordBBox box_;
  std::vector<openvdb::Vec3s> values_;
};

// Sets each pixel to color(x, y), the place of its centre in voxels from the left and from below.
template <typename ColorAt>
Image draw(const Slice& slice, const ColorAt& color) {
  if (slice.empty()) return {kLongestSide, kLongestSide, 3};
  const int scale = std::max(1, kLongestSide / std::max(slice.width(), slice.height()));
  Image image(slice.width() * scale, slice.height() * scale, 3);
  tbb::parallel_for(0, image.height, [&](int row) {
    for (int column = 0; column < image.width; ++column) {
      const Rgb found = color((column + 0.5) / scale, (image.height - row - 0.5) / scale, 1.0 / scale);
      for (int channel = 0; channel < 3; ++channel) {
        image.at(column, row, channel) = std::clamp(found[static_cast<std::size_t>(channel)], 0.0f, 1.0f);
      }
    }
  });
  return image;
}

// White noise for streaks: one value for each cell of the size of a pixel.
float grain(double x, double y, double pixel) {
  const Index<2> cell(static_cast<std::int64_t>(std::floor(x / pixel)),
                      static_cast<std::int64_t>(std::floor(y / pixel)));
  return static_cast<float>(RandomStream(hash_cell<2>(cell, 0)).next_unit());
}

// The mean of the grain along the vectors, from -1 to 1 about its own mean.
float streak(const Slice& slice, double x, double y, double pixel) {
  float sum = grain(x, y, pixel);
  for (const double side : {pixel, -pixel}) {
    double u = x;
    double v = y;
    for (int step = 0; step < kStreak; ++step) {
      const openvdb::Vec3s vector = slice.at(u, v);
      const double along = vector.x();
      const double up = vector[slice.up_axis()];
      const double length = std::hypot(along, up);
      if (length == 0.0) break;
      u += side * along / length;
      v += side * up / length;
      sum += grain(u, v, pixel);
    }
  }
  constexpr float kCount = 2 * kStreak + 1;
  const float sigma = std::sqrt(kCount / 12.0f);
  return std::clamp((sum - 0.5f * kCount) / (2.0f * sigma), -1.0f, 1.0f);
}

Image draw_vectors(const MeasuredGrid& measured, UpAxis up) {
  const Slice slice(*measured.grid, up);
  double mean_square = 0.0;
  for (const Moments& moments : measured.moments) {
    mean_square += moments.mean() * moments.mean() + moments.sigma() * moments.sigma();
  }
  const float full = mean_square > 0.0 ? static_cast<float>(0.5 / std::sqrt(mean_square)) : 0.0f;
  return draw(slice, [&](double x, double y, double pixel) -> Rgb {
    const float length = std::min(full * slice.at(x, y).length(), 1.0f);
    const float light = 0.65f + 0.35f * streak(slice, x, y, pixel);
    return {light * (0.1f + 0.9f * length), light * (0.2f + 0.7f * length), light * (0.55f - 0.25f * length)};
  });
}

Image draw_colors(const MeasuredGrid& measured, const RawShaping& range, UpAxis up) {
  const Slice slice(*measured.grid, up);
  float black = -3.0f;
  float white = 3.0f;
  if (range.range == RawShaping::Range::signed_values) black = -1.0f, white = 1.0f;
  if (range.range == RawShaping::Range::unit) black = 0.0f, white = 1.0f;
  return draw(slice, [&](double x, double y, double) -> Rgb {
    const openvdb::Vec3s value = slice.at(x, y);
    Rgb color;
    for (int i = 0; i < 3; ++i) color[static_cast<std::size_t>(i)] = (value[i] - black) / (white - black);
    return color;
  });
}

// In the colours of the exemplar.
Image draw_exemplar(const MeasuredGrid& measured, const ExemplarModel& exemplar, UpAxis up) {
  const Slice slice(*measured.grid, up);
  return draw(slice, [&](double x, double y, double) -> Rgb {
    Rgb color;
    for (int i = 0; i < 3; ++i) {
      const auto channel = static_cast<std::size_t>(i);
      const float value = std::clamp(slice.at(x, y)[i], 0.0f, 1.0f);
      color[channel] = exemplar.raw_values ? value : encode_light(value);
    }
    return color;
  });
}

Image draw_phasor(const Volume& volume, const std::vector<Output>& outputs, UpAxis up) {
  const Slice first(*volume.grids.front().grid, up);
  const Slice second(*volume.grids.back().grid, up);
  const bool phase_first = outputs.front() == Output::phase;
  const bool both = outputs.size() > 1;
  return draw(first, [&](double x, double y, double) -> Rgb {
    // The phase jumps, so that nothing may be taken between its values.
    const float a = first.nearest(x, y).x();
    const float b = second.nearest(x, y).x();
    const float intensity = both ? (phase_first ? b : a) : (phase_first ? 1.4f : a);
    const float light = 0.5f * intensity;
    if (!both && !phase_first) return {light, light, light};
    const float phase = phase_first ? a : b;
    Rgb color;
    for (std::size_t i = 0; i < 3; ++i) {
      const float third = static_cast<float>(i) * 2.0f * std::numbers::pi_v<float> / 3.0f;
      color[i] = light * (0.5f + 0.5f * std::cos(phase - third));
    }
    return color;
  });
}

}  // namespace

Image render_slice(const Volume& volume, const VolumeRecipe& recipe) {
  switch (recipe.output.front()) {
    case Output::gradient:
    case Output::curl:
      return draw_vectors(volume.grids.front(), recipe.up);
    case Output::color:
      if (const ExemplarModel* const exemplar = exemplar_of_colors(recipe)) {
        return draw_exemplar(volume.grids.front(), *exemplar, recipe.up);
      }
      return draw_colors(volume.grids.front(), std::get<RawShaping>(recipe.shaping), recipe.up);
    case Output::phase:
    case Output::intensity:
      return draw_phasor(volume, recipe.output, recipe.up);
    case Output::value:
      break;
  }
  throw std::invalid_argument("a picture of a slice is of vectors, colours or phases, not of values");
}

}  // namespace solidnoise
