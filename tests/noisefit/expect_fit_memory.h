#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "noisefit/run_noisefit.h"
#include "tools/expect_estimate.h"

namespace solidnoise {

// What --max-memory holds against is as expect_peak() says.
inline void expect_fit_memory(std::vector<std::string> command, const RunOptions& there) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes memory of its own";
#endif
  std::string text;
  for (const std::string& word : command) text += word + " ";
  SCOPED_TRACE(text);
  command.insert(command.end(), {"--kappa", "0.25", "--out", "x.json", "--force"});
  std::vector<std::string> refused = command;
  refused.insert(refused.end(), {"--max-memory", "1"});
  const std::string said = run_noisefit(refused, there).err;
  const std::string::size_type at = said.find(" may need ");
  ASSERT_NE(at, std::string::npos) << said;
  std::string unit;
  double estimate = 0.0;
  std::istringstream(said.substr(at + 10)) >> estimate >> unit;
  ASSERT_EQ(unit, "MiB,") << said;
  expect_peak(estimate * 0x1p20, run_noisefit(command, there), text);
}

}  // namespace solidnoise
