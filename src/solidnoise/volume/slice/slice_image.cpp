#include "solidnoise/volume/slice/slice_image.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include "solidnoise/analysis/periodogram.h"
#include "solidnoise/core/moments.h"
#include "solidnoise/image/color.h"

namespace solidnoise {
namespace {

// One tile, evaluated and put in its place.
void sample_tile(const SliceSource& source, const SlicePlane& plane, const glm::ivec2& first,
                 std::span<DenseField<2>> channels) {
  const ArrayShape<2> shape{channels.front().count};
  const glm::ivec2 count = glm::min(glm::ivec2(source.tile_side()), shape.count - first);
  const auto rows = static_cast<std::size_t>(count.y);
  std::vector<float> values(channels.size() * static_cast<std::size_t>(count.x) * rows);
  source.evaluate(plane, first, count, values);
  auto from = values.begin();
  for (DenseField<2>& channel : channels) {
    for (int column = first.x; column < first.x + count.x; ++column) {
      const auto to = static_cast<std::ptrdiff_t>(shape.index({column, first.y}));
      std::copy_n(from, rows, channel.values.begin() + to);
      from += static_cast<std::ptrdiff_t>(rows);
    }
  }
}

// A picture with the value of `at(column, row from the bottom)` in one channel.
template <typename Value>
Image grey_image(int columns, int rows, const Value& at) {
  Image image(columns, rows, 1);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) image.at(x, y) = static_cast<float>(at(x, rows - 1 - y));
  }
  return image;
}

float value_at(const DenseField<2>& slice, int column, int row) {
  return slice.values[ArrayShape<2>{slice.count}.index({column, row})];
}

}  // namespace

std::vector<DenseField<2>> sample_slice(const SliceSource& source, const SlicePlane& plane,
                                        Progress* progress) {
  const DenseField<2> empty({plane.columns, plane.rows}, Vec<2>(plane.pixel));
  std::vector<DenseField<2>> channels(static_cast<std::size_t>(source.channels()), empty);
  const int side = source.tile_side();
  const glm::ivec2 tiles = (empty.count + (side - 1)) / side;
  const int total = tiles.x * tiles.y;
  std::atomic<int> done = 0;
  tbb::parallel_for(0, total, [&](int tile) {
    throw_if_cancelled(progress);
    sample_tile(source, plane, side * glm::ivec2(tile / tiles.y, tile % tiles.y), channels);
    const int finished = ++done;
    if (progress) progress->advance(static_cast<std::uint64_t>(finished), static_cast<std::uint64_t>(total));
  });
  return channels;
}

std::pair<double, double> shown_values(const SliceRecipe& recipe, const SliceField& field,
                                       std::span<const DenseField<2>> channels) {
  if (recipe.values) return *recipe.values;
  if (field.shown) return *field.shown;
  Moments moments;
  for (const DenseField<2>& slice : channels) moments.merge(Moments::of(slice.values));
  const double low = moments.min();
  return low < moments.max() ? std::pair(low, moments.max()) : std::pair(low - 1.0, low + 1.0);
}

Image slice_image(const SliceRecipe& recipe, const DenseField<2>& slice, std::pair<double, double> shown,
                  PixelForm form) {
  const bool floats = form == PixelForm::values;
  const double low = shown.first;
  const double high = shown.second;
  const auto position = [&](int column, int row) {
    return (value_at(slice, column, row) - low) / (high - low);
  };
  if (recipe.ramp.empty()) {
    if (!floats) return grey_image(slice.count.x, slice.count.y, position);
    return grey_image(slice.count.x, slice.count.y,
                      [&](int column, int row) { return value_at(slice, column, row); });
  }
  const ColorRamp ramp = parse_color_ramp(recipe.ramp);
  Image image(slice.count.x, slice.count.y, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto t = static_cast<float>(position(x, image.height - 1 - y));
      const Color color = floats ? ramp.linear(t) : ramp.srgb(t);
      for (int channel = 0; channel < 3; ++channel) image.at(x, y, channel) = color[channel];
    }
  }
  return image;
}

Image color_image(const SliceField& field, std::span<const DenseField<2>> channels,
                  std::pair<double, double> shown, PixelForm form) {
  const bool floats = form == PixelForm::values;
  const double low = shown.first;
  const double high = shown.second;
  const auto& exemplar = field.exemplar;
  std::optional<ChannelColors> color_of;
  if (exemplar) color_of.emplace(*exemplar, field.variances);
  const glm::ivec2 count = channels[0].count;
  Image image(count.x, count.y, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::array<double, 3> values;
      for (std::size_t c = 0; c < 3; ++c) values[c] = value_at(channels[c], x, image.height - 1 - y);
      Color color;
      if (exemplar) {
        color = Color((*color_of)(values));
        if (!floats && !exemplar->raw_values) color = srgb_from_linear(color);
      } else {
        for (int c = 0; c < 3; ++c) {
          const double value = values[static_cast<std::size_t>(c)];
          color[c] = static_cast<float>(floats ? value : (value - low) / (high - low));
        }
      }
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = color[c];
    }
  }
  return image;
}

Image spectrum_image(const SliceRecipe& recipe, const DenseField<2>& slice, PixelForm form) {
  PeriodogramOptions options;
  options.window = recipe.wraps ? Window::none : Window::hann;
  const PowerSpectrum<2> spectrum = periodogram(slice, options);
  const double highest = *std::max_element(spectrum.density.begin(), spectrum.density.end());
  const double scale = highest > 0.0 ? 1.0 / highest : 0.0;
  const glm::ivec2 count = spectrum.count;
  const bool floats = form == PixelForm::values;
  return grey_image(count.x, count.y, [&](int column, int row) {
    const glm::ivec2 stored((column + count.x - count.x / 2) % count.x,
                            (row + count.y - count.y / 2) % count.y);
    const double density = spectrum.density[ArrayShape<2>{count}.index(stored)];
    if (floats) return density;
    if (recipe.spectrum_scale == SliceRecipe::SpectrumScale::linear) return scale * density;
    constexpr double kDecades = 6.0;  // 60 dB
    return 1.0 + std::log10(std::max(scale * density, 1e-30)) / kDecades;
  });
}

std::string line_table(const SlicePlane& plane, const DenseField<2>& slice) {
  std::string text = "position,value\n";
  for (int column = 0; column < slice.count.x; ++column) {
    text += fmt::format("{:.9g},{:.9g}\n", plane.coordinate(column), value_at(slice, column, 0));
  }
  return text;
}

}  // namespace solidnoise
