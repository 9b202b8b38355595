#pragma once

#include <string>
#include <utility>
#include <vector>

namespace solidnoise {

// Whether the value of a flag is meant as a curve over frames: "0:1,24:3".
bool is_curve(const std::string& text);

// A number that changes from frame to frame: linear between keys, each a frame and its value, held outside.
class FrameCurve {
 public:
  // Throws UsageError that names the flag, the text and what is allowed: frames from 0 on, each after the one
  // before, and finite numbers.
  FrameCurve(const std::string& flag, const std::string& text);

  double at(int frame) const;
  // Those of the keys.
  std::vector<int> frames() const;

 private:
  std::vector<std::pair<int, double>> keys_;
};

}  // namespace solidnoise
