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

// The Progress of one part of an operation: what is done of the part is told as from `begin` to `end` of the
// whole, fractions of 1. The whole's may be null.
class PartialProgress final : public Progress {
 public:
  PartialProgress(Progress* whole, double begin, double end) : whole_(whole), begin_(begin), end_(end) {}

  void advance(std::uint64_t done, std::uint64_t total) override {
    constexpr std::uint64_t kUnits = 1'000'000;
    if (whole_ == nullptr || total == 0) return;
    const double part = static_cast<double>(done) / static_cast<double>(total);
    whole_->advance(static_cast<std::uint64_t>((begin_ + (end_ - begin_) * part) * kUnits), kUnits);
  }
  bool cancelled() override { return whole_ != nullptr && whole_->cancelled(); }

 private:
  Progress* whole_;
  double begin_;
  double end_;
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
