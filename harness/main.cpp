#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <string>

#include "harness/blas.h"
#include "harness/command_line.h"

namespace conebench::harness {
namespace {

// BLAS: one thread, whatever the user's shell says: timed runs must not depend on it. OpenMP: at a
// barrier a thread spins for some 10 us, then sleeps; libgomp's own choice, some ms, costs
// `gs-parallel` ten times the time of a sweep where another process wants the core too. Solvers
// that run as programs of their own inherit all of this.
const std::map<std::string, std::string> kThreadVariables{{"OMP_NUM_THREADS", "1"},
                                                          {"OPENBLAS_NUM_THREADS", "1"},
                                                          {"MKL_NUM_THREADS", "1"},
                                                          {"GOMP_SPINCOUNT", "1000"}};
constexpr const char* kBlasKernels = "OPENBLAS_CORETYPE";

// These are read when libraries are loaded, before main(): so the program starts itself again with
// them set. Kernels of BLAS that the user has chosen stay.
void set_library_variables(char** argv) {
  auto variables = kThreadVariables;
  if (std::getenv(kBlasKernels) == nullptr) {
    const auto kernels = better_blas_kernels(blas_kernels(), VectorUnits::of_this_processor());
    if (kernels) variables[kBlasKernels] = *kernels;
  }
  bool set = true;
  for (const auto& [name, value] : variables) {
    const char* found = std::getenv(name.c_str());
    if (found != nullptr && found == value) continue;
    set = false;
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  if (!set) ::execv("/proc/self/exe", argv);
}

}  // namespace
}  // namespace conebench::harness

int main(int argc, char** argv) {
  conebench::harness::set_library_variables(argv);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit becomes an error that write() returns
  return conebench::harness::run_program({argv + 1, argv + argc});
}
