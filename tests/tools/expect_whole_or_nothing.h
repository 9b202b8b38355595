#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/paths.h"
#include "support/temporary_folder.h"
#include "tools/run_tool.h"

namespace solidnoise {

// What a program's environment needs for a fault, such as "write 3 fail": see support/failing_calls.cpp.
inline std::vector<std::string> failing_calls(const std::string& fault) {
  return {"LD_PRELOAD=" + in_build("lib/failing_calls.so"), "ASAN_OPTIONS=verify_asan_link_order=0",
          "SOLIDNOISE_FAULT=" + fault};
}

// Runs a program again and again in a folder, with the first, the second, ... call of a kind failing, or the
// process dying at it, until it does not come to that call any more; from the third on some are left out.
// Each time the outputs must be absent or what they are without faults, those of a failure all absent; of
// other files there may be none. `replaced` is what an output has before, by its name.
//
// A process that dies may leave some outputs of several, and a hidden file where it replaces one: see
// write_output().
inline void expect_whole_or_nothing(const std::function<ToolResult(const RunOptions&)>& run,
                                    const TemporaryFolder& folder,
                                    const std::map<std::string, std::string>& replaced = {}) {
  const auto restore = [&](const std::set<std::string>& before) {
    for (const std::string& name : folder.names()) {
      if (before.count(name) == 0) std::filesystem::remove(folder / name);
    }
    for (const auto& [name, content] : replaced) folder.write(name, content);
  };
  restore(folder.names());
  const std::set<std::string> before = folder.names();
  ASSERT_EQ(run({.folder = folder.path()}).status, 0);
  const std::set<std::string> after = folder.names();
  std::map<std::string, std::string> whole;
  for (const std::string& name : after) whole[name] = folder.read(name);

  for (const std::string call : {"malloc", "write", "fsync", "linkat", "rename", "renameat2"}) {
    for (const bool dies : {false, true}) {
      if (dies && call == "malloc") continue;
      constexpr int kMostCalls = 10000;
      for (int number = 1; number <= kMostCalls; number += 1 + number / 3) {
        restore(before);
        const std::string fault = call + " " + std::to_string(number) + (dies ? " kill" : " fail");
        SCOPED_TRACE(fault);
        const ToolResult result = run({.folder = folder.path(), .environment = failing_calls(fault)});
        const bool done = result.status == 0;  // it may do without some memory
        // OpenImageIO's libraries end the process where there is no memory to load them.
        if (dies) {
          ASSERT_TRUE(done || result.signal == SIGKILL) << result.err;
        } else if (!done && !(call == "malloc" && result.signal != 0)) {
          ASSERT_EQ(result.status, 1) << result.err;
        }
        for (const std::string& name : folder.names()) {
          const bool may_be_hidden = dies && !replaced.empty() && name.find(".tmp-") != std::string::npos;
          if (may_be_hidden) continue;
          ASSERT_EQ(after.count(name), 1u) << name << " is left";
          if (before.count(name) == 0) {
            ASSERT_TRUE(done || dies) << name << " is there";
          }
          const auto old = replaced.find(name);
          const bool as_before = old != replaced.end() && folder.read(name) == old->second;
          ASSERT_TRUE((as_before && !done) || folder.read(name) == whole[name]) << name << " is not whole";
          if (!done && !dies && old != replaced.end()) {
            ASSERT_TRUE(as_before) << name << " is replaced";
          }
        }
        if (result.err.find("the call has failed") == std::string::npos) break;
        ASSERT_LT(2 * number, kMostCalls);
      }
    }
  }
  restore(before);
}

}  // namespace solidnoise
