#pragma once

#include <cmath>
#include <functional>
#include <sstream>
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

// What --max-memory holds against, where nothing describes it, is as expect_peak() says: the last refusal's
// estimate as the limit is raised to what each says. --max-time refuses the command too.
inline void expect_limits(const std::function<ToolResult(const std::vector<std::string>&)>& run,
                          const std::vector<std::string>& command) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes memory of its own";
#endif
  std::string text;
  for (const std::string& word : command) text += word + " ";
  SCOPED_TRACE(text);
  const auto run_within = [&](const std::string& flag, const std::string& limit) {
    std::vector<std::string> limited = command;
    limited.insert(limited.end(), {flag, limit});
    return run(limited);
  };
  const ToolResult slow = run_within("--max-time", "1e-9");
  EXPECT_EQ(slow.status, 1);
  EXPECT_NE(slow.err.find(" seconds, --max-time allows 1e-09"), std::string::npos) << slow.err;
  double estimate = 0.0;
  ToolResult result = run_within("--max-memory", "1");
  for (int raised = 0; raised < 9 && result.status == 1; ++raised) {
    const std::string::size_type at = result.err.find(" may need ");
    ASSERT_NE(at, std::string::npos) << result.err;
    std::string unit;
    std::istringstream(result.err.substr(at + 10)) >> estimate >> unit;
    ASSERT_EQ(unit, "MiB,") << result.err;
    constexpr double kRounding = 0.1;
    result = run_within("--max-memory", std::to_string(std::ceil((estimate + kRounding) * 0x1p20)));
  }
  EXPECT_GT(estimate, 0.0);
  expect_peak(estimate * 0x1p20, result, text);
}

}  // namespace solidnoise
