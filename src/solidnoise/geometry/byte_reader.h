#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace solidnoise {

// Takes numbers off the front of a file's bytes. Precondition of each function: as many are left.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::endian order) : rest_(bytes), swap_(order != std::endian::native) {}

  std::size_t left() const { return rest_.size(); }

  std::string_view take_bytes(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  template <typename Number>
  Number take() {
    char raw[sizeof(Number)];
    std::memcpy(raw, rest_.data(), sizeof raw);
    rest_.remove_prefix(sizeof raw);
    if (swap_) std::reverse(raw, raw + sizeof raw);
    Number number;
    std::memcpy(&number, raw, sizeof raw);
    return number;
  }

 private:
  std::string_view rest_;
  bool swap_;
};

}  // namespace solidnoise
