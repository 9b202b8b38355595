#pragma once

#include <cstdint>
#include <stdexcept>

namespace solidnoise {

// What a long operation tells its caller, and asks. Both functions may be called from any thread, many times
// a second; they must be quick and must not throw.
class Progress {
 public:
  virtual ~Progress() = default;

  // `done` of `total` units of work are finished. Where several threads work, calls may overlap and `done`
  // may arrive out of order.
  virtual void advance(std::uint64_t done, std::uint64_t total) = 0;

  // True to stop: the operation then throws Cancelled, and leaves nothing behind.
  virtual bool cancelled() = 0;
};

// The caller's Progress asked to stop.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

// Throws Cancelled if `progress`, which may be null, asks to stop.
inline void throw_if_cancelled(Progress* progress) {
  if (progress != nullptr && progress->cancelled()) throw Cancelled();
}

}  // namespace solidnoise
