#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace solidnoise {

// A fingerprint of numbers: 64 bits, FNV-1a (Fowler, Noll, Vo) of their bytes in the order in which they are
// added. Numbers that differ in one bit have different ones.
class Digest {
 public:
  template <typename Number>
  void add(std::span<const Number> numbers) {
    const auto bytes = std::as_bytes(numbers);
    for (const std::byte byte : bytes) hash_ = (hash_ ^ static_cast<std::uint64_t>(byte)) * kPrime;
  }
  template <typename Number>
  void add_one(const Number& number) {
    add(std::span<const Number>(&number, 1));
  }
  // With its length: "ab" and "c" are not "a" and "bc".
  void add(std::string_view text) {
    add_one(static_cast<std::uint64_t>(text.size()));
    add(std::span<const char>(text));
  }

  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace solidnoise
