#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solidnoise/image/image_file.h"
#include "support/temporary_folder.h"
#include "tools/run_vdbnoise.h"

namespace solidnoise {

inline ToolResult run_slice(const std::vector<std::string>& flags, const RunOptions& options = {}) {
  std::vector<std::string> arguments{"slice", "--quiet"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return run_vdbnoise(arguments, options);
}

// The values that a slice with these flags has, row 0 at the top.
inline Image slice(std::vector<std::string> flags) {
  const TemporaryFolder folder;
  flags.insert(flags.end(), {"--out", folder.file("x.exr")});
  const ToolResult result = run_slice(flags);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.status == 0 ? read_image(folder.file("x.exr")) : Image(1, 1, 1);
}

}  // namespace solidnoise
