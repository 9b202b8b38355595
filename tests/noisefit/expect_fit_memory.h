#pragma once

#include <string>
#include <vector>

#include "noisefit/run_noisefit.h"
#include "tools/expect_estimate.h"

namespace solidnoise {

inline void expect_fit_memory(std::vector<std::string> command, const RunOptions& there) {
  command.insert(command.end(), {"--kappa", "0.25", "--out", "x.json", "--force"});
  expect_limits([&](const std::vector<std::string>& arguments) { return run_noisefit(arguments, there); },
                command);
}

}  // namespace solidnoise
