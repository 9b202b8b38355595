#pragma once

#include <stdexcept>

namespace solidnoise {

// A command line that cannot be obeyed: exit status 2. The message is one line that names the flag, its value
// and what is allowed.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace solidnoise
