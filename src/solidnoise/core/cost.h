#pragma once

namespace solidnoise {

// What work takes beside its results, told before it begins.
struct Cost {
  double seconds = 0.0;  // of one core of 2023 (3 GHz, AVX-512), without other work beside it
  double bytes = 0.0;    // of memory at most

  Cost& operator+=(const Cost& other) {
    seconds += other.seconds;
    bytes += other.bytes;
    return *this;
  }
};

}  // namespace solidnoise
