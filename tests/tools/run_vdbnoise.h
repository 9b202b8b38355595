#pragma once

#include <string>
#include <vector>

#include "tools/run_tool.h"

namespace solidnoise {

inline ToolResult run_vdbnoise(const std::vector<std::string>& arguments, const RunOptions& options = {}) {
  return RunningTool(SOLIDNOISE_VDBNOISE, arguments, options).wait();
}

}  // namespace solidnoise
