#pragma once

#include <string>

namespace solidnoise {

// From here on SIGINT, SIGTERM and SIGHUP only raise a flag, so that a run can stop in order and remove what
// it began. A second signal ends the process at once.
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

}  // namespace solidnoise
