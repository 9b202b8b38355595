#pragma once

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/run_tool.h"

namespace solidnoise {

// A command line that must be refused, with what the message must say.
struct Refusal {
  const char* name;
  int status;  // 2 for wrong usage, 1 for wrong files
  std::vector<std::string> arguments;
  std::vector<std::string> says;
};

inline void PrintTo(const Refusal& refusal, std::ostream* stream) {
  *stream << refusal.name;
}

// The message is one line that names flag or file, value and what is allowed; for wrong usage one more
// follows, with where to find help: about `command`, such as "vdbnoise" or "vdbnoise info".
inline void expect_refusal(const ToolResult& result, const Refusal& refusal, const std::string& command) {
  EXPECT_EQ(result.status, refusal.status) << result.err;
  EXPECT_TRUE(result.err.starts_with(command.substr(0, command.find(' ')) + ": ")) << result.err;
  for (const std::string& text : refusal.says) {
    EXPECT_NE(result.err.find(text), std::string::npos) << "lacks \"" << text << "\": " << result.err;
  }
  const std::ptrdiff_t lines = std::count(result.err.begin(), result.err.end(), '\n');
  EXPECT_EQ(lines, refusal.status == 2 ? 2 : 1) << result.err;
  EXPECT_EQ(result.err.ends_with("Try " + command + " --help\n"), refusal.status == 2) << result.err;
  EXPECT_EQ(result.out, "");
}

}  // namespace solidnoise
