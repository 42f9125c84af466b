#include "harness/interrupt.h"

#include <csignal>

namespace conebench::harness {
namespace {

volatile std::sig_atomic_t arrived = 0;

extern "C" void note_interrupt(int) { arrived = 1; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  sigemptyset(&action.sa_mask);
  // No SA_RESTART: a waiting poll() returns at once.
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return arrived != 0; }

}  // namespace conebench::harness
