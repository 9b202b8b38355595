#pragma once

namespace solidnoise {

// From here on SIGINT, SIGTERM and SIGHUP only raise a flag, so that a run can stop in order and remove what
// it began. A second signal ends the process at once.
void catch_interrupts();

// The signal that came, or 0.
int interrupt_signal();

}  // namespace solidnoise
