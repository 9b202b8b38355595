#pragma once

#include <functional>
#include <string>

namespace solidnoise {

// How every tool ends.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 128;  // plus the signal's number, as a shell has it

// Runs a tool and maps what it throws to an exit status and one line on the standard error: TextRequested
// (printed to the standard output), UsageError, Cancelled, any other std::exception.
int run_tool(const char* tool, const std::function<int()>& run);

// Runs a command of a tool, such as "meshnoise bake", so that a UsageError leads to the command's own --help.
int run_command(const std::string& command, const std::function<int()>& run);

}  // namespace solidnoise
