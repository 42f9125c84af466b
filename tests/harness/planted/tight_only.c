/* Right where the tolerance is tight, a claim without an answer where it is not. */
#define conebench_plugin_entry example_entry
#define solve example_solve
#include "examples/c/my_solver.c"
#undef solve
#undef conebench_plugin_entry

#include "planted.h"

const conebench_plugin* conebench_plugin_entry(void);

static const conebench_value kOmega = {sizeof(conebench_value), 0, 0, 1.0, NULL};

PLANTED_SOLVE {
  if (stop->tol <= 1e-10) {
    example_solve(problem, &kOmega, stop, host, result);
  } else {
    PLANTED_ANSWER(CONEBENCH_CONVERGED);
  }
}
