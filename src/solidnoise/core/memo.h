#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace solidnoise {

// The latest results of something that takes long, by what they are of. Not to be shared by threads.
template <typename Key, typename Value, std::size_t kMost = 32>
class Memo {
 public:
  // The value of `key`, which make() finds where it is not known.
  template <typename Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    for (const auto& [known, value] : entries_) {
      if (known == key) return value;
    }
    auto value = std::make_shared<const Value>(make());
    if (entries_.size() < kMost) {
      entries_.emplace_back(key, value);
    } else {
      entries_[oldest_] = {key, value};
      oldest_ = (oldest_ + 1) % kMost;
    }
    return value;
  }

 private:
  std::vector<std::pair<Key, std::shared_ptr<const Value>>> entries_;
  std::size_t oldest_ = 0;
};

}  // namespace solidnoise
