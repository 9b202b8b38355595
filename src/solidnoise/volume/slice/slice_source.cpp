#include "solidnoise/volume/slice/slice_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace solidnoise {
namespace {

std::vector<Vec<3>> positions_of(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count) {
  std::vector<Vec<3>> positions;
  positions.reserve(static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y));
  for (int column = first.x; column < first.x + count.x; ++column) {
    for (int row = first.y; row < first.y + count.y; ++row) positions.push_back(plane.position(column, row));
  }
  return positions;
}

class FieldSource final : public SliceSource {
 public:
  FieldSource(FieldPtr field, const SlicedChannels& sliced) : field_(std::move(field)), sliced_(sliced) {}

  int channels() const override { return sliced_.component ? 1 : sliced_.count; }

  void evaluate(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count,
                std::span<float> values) const override {
    const std::vector<Vec<3>> positions = positions_of(plane, first, count);
    const auto all = static_cast<std::size_t>(field_->channels());
    if (all == 1) return field_->evaluate({positions}, {values, {}});
    std::vector<float> channels(all * positions.size());
    field_->evaluate({positions}, {channels, {}});
    const auto from_channel = [&](int k) {
      return std::span<const float>(channels).subspan(static_cast<std::size_t>(sliced_.first + k) *
                                                      positions.size());
    };
    if (sliced_.component == Component::length) {
      const auto x = from_channel(0);
      const auto y = from_channel(1);
      const auto z = from_channel(2);
      for (std::size_t i = 0; i < positions.size(); ++i) values[i] = std::hypot(x[i], y[i], z[i]);
    } else {
      const int k = sliced_.component ? static_cast<int>(*sliced_.component) : 0;
      std::copy_n(from_channel(k).begin(), values.size(), values.begin());
    }
  }

  int tile_side() const override { return 32; }

 private:
  FieldPtr field_;
  SlicedChannels sliced_;
};

class JoinedSource final : public SliceSource {
 public:
  explicit JoinedSource(std::vector<SliceSourcePtr> sources) : sources_(std::move(sources)) {}

  int channels() const override {
    int channels = 0;
    for (const SliceSourcePtr& source : sources_) channels += source->channels();
    return channels;
  }

  void evaluate(const SlicePlane& plane, const glm::ivec2& first, const glm::ivec2& count,
                std::span<float> values) const override {
    const auto pixels = static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y);
    for (const SliceSourcePtr& source : sources_) {
      const std::size_t own = static_cast<std::size_t>(source->channels()) * pixels;
      source->evaluate(plane, first, count, values.first(own));
      values = values.subspan(own);
    }
  }

  int tile_side() const override { return sources_.front()->tile_side(); }

 private:
  std::vector<SliceSourcePtr> sources_;
};

}  // namespace

SliceSourcePtr make_slice_source(FieldPtr field) {
  const int channels = field->channels();
  return make_slice_source(std::move(field), {0, channels});
}

SliceSourcePtr make_slice_source(FieldPtr field, const SlicedChannels& channels) {
  return std::make_shared<FieldSource>(std::move(field), channels);
}

SliceSourcePtr side_by_side(std::vector<SliceSourcePtr> sources) {
  return sources.size() == 1 ? sources.front() : std::make_shared<JoinedSource>(std::move(sources));
}

}  // namespace solidnoise
