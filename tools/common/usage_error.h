#pragma once

#include <stdexcept>
#include <string>
#include <utility>

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

}  // namespace solidnoise
