#pragma once

#include <exception>
#include <string>

namespace solidnoise {

// The message of the exception of type Error that `action` throws, or a sentence that says it threw none.
// Exceptions of other types go on to the test runner, which reports them.
template <typename Error, typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace solidnoise
