#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "harness/command_line.h"

namespace {

struct Variable {
  const char *name, *value;
};

// BLAS: one thread, whatever the user's shell says: timed runs must not depend on it. OpenMP: at a
// barrier a thread spins for some 10 us, then sleeps; libgomp's own choice, some ms, costs
// `gs-parallel` ten times the time of a sweep where another process wants the core too. Solvers
// that run as programs of their own inherit all of this.
constexpr Variable kThreadVariables[] = {{"OMP_NUM_THREADS", "1"},
                                         {"OPENBLAS_NUM_THREADS", "1"},
                                         {"MKL_NUM_THREADS", "1"},
                                         {"GOMP_SPINCOUNT", "1000"}};

// These are read when libraries are loaded, before main(): so the program starts itself again with
// them set.
void set_thread_variables(char** argv) {
  bool set = true;
  for (const auto& [name, value] : kThreadVariables) {
    const char* found = std::getenv(name);
    if (found != nullptr && std::string(found) == value) continue;
    set = false;
    ::setenv(name, value, 1);
  }
  if (!set) ::execv("/proc/self/exe", argv);
}

}  // namespace

int main(int argc, char** argv) {
  set_thread_variables(argv);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit becomes an error that write() returns
  return conebench::harness::run_program({argv + 1, argv + argc});
}
