/* Fails where a cone with mu = 0.125 and one with mu = 0.375 meet, in the way that it is told to;
 * solves everything else. */
#define conebench_plugin_entry example_entry
#define solve example_solve
#include "examples/c/my_solver.c"
#undef solve
#undef conebench_plugin_entry

#include <math.h>
#include <unistd.h>

static const char* const kWays[] = {"stalled", "abort", "hang", "nan", "liar", NULL};

static const conebench_parameter kHow[] = {
    CONEBENCH_TEXT_PARAMETER("how", "stalled", kWays, "how it fails")};

static const conebench_value kOmega = {sizeof(conebench_value), 0, 0, 1.0, NULL};

static int has(const conebench_problem* problem, double mu) {
  for (int32_t i = 0; i < problem->cones; ++i)
    if (problem->mu[i] == mu) return 1;
  return 0;
}

static void solve(const conebench_problem* problem, const conebench_value* values,
                  const conebench_stop* stop, const conebench_host* host,
                  conebench_result* result) {
  const char* how = values[0].text;
  if (!has(problem, 0.125) || !has(problem, 0.375)) {
    example_solve(problem, &kOmega, stop, host, result);
    return;
  }
  if (strcmp(how, "abort") == 0) abort();
  while (strcmp(how, "hang") == 0) pause();
  if (strcmp(how, "nan") == 0) result->r[0] = NAN;
  result->r_size = (size_t)problem->rows;
  result->status = strcmp(how, "stalled") == 0 ? CONEBENCH_STALLED : CONEBENCH_CONVERGED;
}

const conebench_plugin* conebench_plugin_entry(void) {
  static const conebench_plugin kPlugin = {sizeof(conebench_plugin),
                                           CONEBENCH_ABI_VERSION,
                                           "pair",
                                           "fails where two cones meet",
                                           kHow,
                                           1,
                                           refuses,
                                           solve};
  return &kPlugin;
}
