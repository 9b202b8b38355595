#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tools/run_tool.h"

namespace solidnoise {

// The memory that a run took at its peak is below an estimate, and above a half of it.
inline void expect_peak(double estimate, const ToolResult& made, const std::string& command) {
  ASSERT_EQ(made.status, 0) << command << made.err;
  EXPECT_LT(made.peak_memory, estimate) << command;
  EXPECT_GT(made.peak_memory, 0.5 * estimate) << command;
}

// The estimate of --describe is as expect_peak() says. `run`
// runs the program; `writing` is what lets the command write.
inline void expect_estimate(const std::function<ToolResult(const std::vector<std::string>&)>& run,
                            std::vector<std::string> command, const std::vector<std::string>& writing) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes memory of its own";
#endif
  std::string text;
  for (const std::string& word : command) text += word + " ";
  command.insert(command.end(), {"--threads", "2", "--quiet"});
  std::vector<std::string> describing = command;
  describing.push_back("--describe");
  const ToolResult described = run(describing);
  ASSERT_EQ(described.status, 0) << text << described.err;
  const double estimate = nlohmann::json::parse(described.out)["cost"]["memory_bytes"];
  command.insert(command.end(), writing.begin(), writing.end());
  expect_peak(estimate, run(command), text);
}

}  // namespace solidnoise
