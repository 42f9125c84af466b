#include "solvers/linear/threads.h"

#include <dlfcn.h>

namespace conebench::solvers {
namespace {

// Which BLAS is loaded is the system's choice, so its thread control may or may not exist.
void call(const char* name, int value) {
  if (void* symbol = dlsym(RTLD_DEFAULT, name)) reinterpret_cast<void (*)(int)>(symbol)(value);
}

bool pin() {
  call("openblas_set_num_threads", 1);
  call("omp_set_num_threads", 1);
  // CHOLMOD asks for four threads whatever that number is: no parallel region may be active.
  call("omp_set_max_active_levels", 0);
  return true;
}

}  // namespace

void pin_library_threads() { [[maybe_unused]] static const bool done = pin(); }

}  // namespace conebench::solvers
