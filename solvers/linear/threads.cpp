#include "solvers/linear/threads.h"

#include <dlfcn.h>

namespace conebench::solvers {
namespace {

// Which BLAS is loaded is the system's choice, so its thread control may or may not exist.
void call(const char* name, int value) {
  if (void* symbol = dlsym(RTLD_DEFAULT, name)) reinterpret_cast<void (*)(int)>(symbol)(value);
}

bool pin(int threads) {
  call("openblas_set_num_threads", threads);
  call("omp_set_num_threads", threads);
  // CHOLMOD asks for four threads whatever that number is: with one, no parallel region at all.
  call("omp_set_max_active_levels", threads > 1 ? 1 : 0);
  return true;
}

}  // namespace

void pin_library_threads(int threads) { [[maybe_unused]] static const bool done = pin(threads); }

}  // namespace conebench::solvers
