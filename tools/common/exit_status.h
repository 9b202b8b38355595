#pragma once

#include <functional>

namespace solidnoise {

// How every tool ends.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 128;  // plus the signal's number, as a shell has it

// Runs a tool and maps what it throws to an exit status and one line on the standard error: TextRequested
// (printed to the standard output), UsageError, Cancelled, any other std::exception.
int run_tool(const char* tool, const std::function<int()>& run);

}  // namespace solidnoise
