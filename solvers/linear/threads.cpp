#include "solvers/linear/threads.h"

#include <dlfcn.h>

#include <initializer_list>

namespace conebench::solvers {
namespace {

// Which BLAS is loaded is the system's choice, so its thread control may or may not exist.
bool pin() {
  for (const char* name : {"openblas_set_num_threads", "omp_set_num_threads"}) {
    if (void* symbol = dlsym(RTLD_DEFAULT, name)) {
      reinterpret_cast<void (*)(int)>(symbol)(1);
    }
  }
  return true;
}

}  // namespace

void pin_library_threads() { [[maybe_unused]] static const bool done = pin(); }

}  // namespace conebench::solvers
