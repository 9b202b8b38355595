#pragma once

#include <string>
#include <vector>

#include "support/paths.h"
#include "tools/run_tool.h"

namespace solidnoise {

inline ToolResult run_meshnoise(const std::vector<std::string>& arguments, const RunOptions& options = {}) {
  return RunningTool(in_build("tools/meshnoise"), arguments, options).wait();
}

}  // namespace solidnoise
