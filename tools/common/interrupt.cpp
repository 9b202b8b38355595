#include "common/interrupt.h"

#include <csignal>

namespace solidnoise {
namespace {

volatile std::sig_atomic_t received_signal = 0;

extern "C" void receive_signal(int signal) {
  received_signal = signal;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = receive_signal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
}

int interrupt_signal() {
  return received_signal;
}

}  // namespace solidnoise
