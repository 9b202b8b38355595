#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace solidnoise {

// A command line that cannot be obeyed: exit status 2. The message is one line that names the flag, its value
// and what is allowed. `command` is the one whose --help helps; empty: the program's.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message, std::string command = {})
      : std::runtime_error(message), command_(std::move(command)) {}

  const std::string& command() const { return command_; }

 private:
  std::string command_;
};

// From here on SIGINT, SIGTERM, SIGHUP and SIGXCPU only raise a flag, so that a run can stop in order and
// remove what it began. A second signal ends the process at once.
void catch_interrupts();

// The signal that came, or 0.
int interrupt_signal();

// What an interruption leaves, for its message: at first "nothing is written".
void set_what_is_left(const std::string& what);
std::string interruption_message();

// While one lives, a signal ends the process at once, with the message and exit status of a run that stops in
// order: for what cannot ask, such as reading a file, and before anything is begun that would have to be
// removed. Throws Cancelled if a signal came already.
class EndsAtOnce {
 public:
  EndsAtOnce();
  ~EndsAtOnce();
  EndsAtOnce(const EndsAtOnce&) = delete;
  EndsAtOnce& operator=(const EndsAtOnce&) = delete;
};

// How every tool ends.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 128;  // plus the signal's number, as a shell has it

// Runs a tool and maps what it throws to an exit status and one line on the standard error: TextRequested
// (printed to the standard output), UsageError, Cancelled, any other std::exception. What it prints by
// std::cout is written at its end, and checked; control characters are escaped there as in messages.
int run_tool(const char* tool, const std::function<int()>& run);

// A command of a tool, such as "bake" of meshnoise: its arguments follow its name.
struct Command {
  std::string_view name;
  int (*run)(const std::vector<std::string>& arguments);
};

// Runs the command that the first argument names, so that a UsageError leads to the command's own --help; or
// `otherwise`, with all arguments, where that is none. Throws UsageError where it is nearly one, unless there
// is a file of its name.
int run_commands(const std::string& tool, std::span<const Command> commands,
                 const std::vector<std::string>& arguments,
                 int (*otherwise)(const std::vector<std::string>& arguments));

}  // namespace solidnoise
