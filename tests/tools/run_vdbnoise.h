#pragma once

#include <string>
#include <vector>

#include "support/paths.h"
#include "tools/run_tool.h"

namespace solidnoise {

inline ToolResult run_vdbnoise(const std::vector<std::string>& arguments, const RunOptions& options = {}) {
  return RunningTool(in_build("tools/vdbnoise"), arguments, options).wait();
}

}  // namespace solidnoise
