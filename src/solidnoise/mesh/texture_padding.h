#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "solidnoise/core/image.h"
#include "solidnoise/mesh/texture_plan.h"

namespace solidnoise {

// Gives texels next to those that have a value the mean of these, round by round.
class TexturePadding {
 public:
  TexturePadding(int size, std::span<const Texel> texels)
      : size_(size), set_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {
    for (const Texel& texel : texels) set_[texel.index] = 1;
    front_.reserve(texels.size());
    for (const Texel& texel : texels) front_.push_back(texel.index);
  }

  void grow(std::vector<Image>& images) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t index : front_) {
      for_each_neighbour(index, [&](std::uint32_t near) {
        if (set_[near] != 0) return;
        set_[near] = 2;
        next.push_back(near);
      });
    }
    for (Image& image : images) {
      tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t i) { fill(image, next[i]); });
    }
    for (const std::uint32_t index : next) set_[index] = 1;
    front_ = std::move(next);
  }

 private:
  template <typename Use>
  void for_each_neighbour(std::uint32_t index, const Use& use) const {
    const auto size = static_cast<std::uint32_t>(size_);
    const int x = static_cast<int>(index % size);
    const int y = static_cast<int>(index / size);
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, size_ - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, size_ - 1); ++i) {
        use(static_cast<std::uint32_t>(j) * size + static_cast<std::uint32_t>(i));
      }
    }
  }

  void fill(Image& image, std::uint32_t index) const {
    const auto channels = static_cast<std::size_t>(image.channels);
    int count = 0;
    for_each_neighbour(index, [&](std::uint32_t near) {
      if (set_[near] != 1) return;
      ++count;
      for (std::size_t c = 0; c < channels; ++c)
        image.pixels[index * channels + c] += image.pixels[near * channels + c];
    });
    for (std::size_t c = 0; c < channels; ++c)
      image.pixels[index * channels + c] /= static_cast<float>(count);
  }

  int size_;
  std::vector<char> set_;  // 1: has a value; 2: is getting one
  std::vector<std::uint32_t> front_;
};

}  // namespace solidnoise
