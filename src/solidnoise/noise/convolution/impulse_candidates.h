#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace solidnoise {

// Where samples are, that impulses have to reach: along each axis, in cells from a corner.
struct CandidateBox {
  int dimensions = 0;
  const float* lower = nullptr;
  const float* upper = nullptr;
  const float* scale = nullptr;  // to radii of the support
  bool is_ball = true;           // the support; else a box
  float most = 1.0f;             // squared distance, in radii, of what is in reach
  int halvings = 0;              // of strata into pieces (ImpulseCount)
  std::int32_t places = 1;       // of a stratum: impulses of this number and higher are mirror images
  bool mixes_keys = false;       // which are hashes of strata, unmixed
};

// Impulses of which it is known what their positions are drawn with, not yet where they are.
struct ImpulseCandidates {
  static constexpr std::size_t kMost = 64;

  std::size_t count = 0;
  std::array<std::uint64_t, kMost> key;     // of the stream that the place is drawn from
  std::array<std::uint32_t, kMost> piece;   // of its stratum, where that is cut into pieces
  std::array<std::uint32_t, kMost> number;  // in its stratum
  // Along each axis, of the stratum's corner in 2^-20 of a cell; then of the impulse itself.
  std::array<std::array<std::int32_t, kMost>, 4> position;

  bool full() const { return count == kMost; }
};

// Draws the positions of candidates, and mixes their keys where wanted. Bit k says whether candidate k is in
// reach.
std::uint64_t place_candidates(const CandidateBox& box, ImpulseCandidates& candidates);

}  // namespace solidnoise
