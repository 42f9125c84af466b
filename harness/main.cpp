#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "harness/command_line.h"

namespace {

constexpr const char* kThreadVariables[] = {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS",
                                            "MKL_NUM_THREADS"};

// BLAS libraries read their thread counts when they are loaded, before main(): so the program
// starts itself again with them set. One thread, whatever the user's shell says: timed runs must
// not depend on it.
void pin_blas_threads(char** argv) {
  bool pinned = true;
  for (const char* name : kThreadVariables) {
    const char* value = std::getenv(name);
    if (value != nullptr && std::string(value) == "1") continue;
    pinned = false;
    ::setenv(name, "1", 1);
  }
  if (!pinned) ::execv("/proc/self/exe", argv);
}

}  // namespace

int main(int argc, char** argv) {
  pin_blas_threads(argv);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit becomes an error that write() returns
  return conebench::harness::run_program({argv + 1, argv + argc});
}
