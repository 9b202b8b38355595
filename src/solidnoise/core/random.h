#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solidnoise/core/vec.h"

namespace solidnoise {

inline constexpr std::uint64_t kMixFactors[] = {0xbf58476d1ce4e5b9ULL, 0x94d049bb133111ebULL};

// Bijective mixing of 64 bits: each output bit depends on each input bit. (Stafford's variant 13 of the
// MurmurHash3 finalizer, as used by SplitMix64.)
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * kMixFactors[0];
  z = (z ^ (z >> 27)) * kMixFactors[1];
  return z ^ (z >> 31);
}

inline constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15ULL;

// A key for independent random streams of one seed: one per purpose, octave or level.
constexpr std::uint64_t derive_seed(std::uint64_t seed, std::uint64_t stream) {
  return mix_bits(mix_bits(seed + kGoldenGamma) ^ (stream * kGoldenGamma + 0x632be59bd9b4e019ULL));
}

// Takes one more coordinate into a hash; before its bits are mixed.
constexpr std::uint64_t unmixed_hash(std::uint64_t hash, std::int64_t coordinate) {
  return hash + kGoldenGamma + static_cast<std::uint64_t>(coordinate);
}
constexpr std::uint64_t hash_coordinate(std::uint64_t hash, std::int64_t coordinate) {
  return mix_bits(unmixed_hash(hash, coordinate));
}

// The key of a cell's random stream: a hash of all of its coordinates and the seed. It has no period; that
// two given cells have the same one is as likely as 2^-64.
template <int Dim>
std::uint64_t hash_cell(const Index<Dim>& cell, std::uint64_t key) {
  std::uint64_t hash = key;
  for (int axis = 0; axis < Dim; ++axis) {
    hash = hash_coordinate(hash, cell[axis]);
  }
  return hash;
}

// Counter-based random numbers: draw k of a stream is a hash of the stream's key and k. Name each draw: the
// order of the draws is part of the noise's definition.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key) : state_(key) {}

  std::uint64_t next() { return mix_bits(state_ += kGoldenGamma); }

  // Uniform on [0, 1), in steps of 2^-53.
  double next_unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

// Draws numbers 0 to n - 1 with given probabilities, in order: the inverse of their distribution. In constant
// time, for a guide tells where in the table to begin (Chen and Asau 1974).
class CumulativeTable {
 public:
  // Weights are probabilities up to a factor. Throws std::invalid_argument if one is negative or not finite,
  // if they add up to 0, or if there are more than 2^20.
  explicit CumulativeTable(std::span<const double> weights);

  std::size_t size() const { return upto_.size(); }

  // The number for a uniform `unit` in [0, 1): it grows with it.
  std::size_t draw(double unit) const {
    std::size_t number = guide_[static_cast<std::size_t>(unit * static_cast<double>(size()))];
    while (unit >= upto_[number]) ++number;
    return number;
  }

 private:
  std::vector<double>
      upto_;  // the probability of a number and all before it; of the last that has one, and after it, 1
  std::vector<std::uint32_t> guide_;  // the number for each multiple of 1 / n
};

}  // namespace solidnoise
