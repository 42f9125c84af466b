/* What the planted solvers share: a library whose solve() is what follows PLANTED_SOLVE. */
#ifndef CONEBENCH_TESTS_PLANTED_H
#define CONEBENCH_TESTS_PLANTED_H

#include <stddef.h>

#include "harness/plugin_api.h"

#define PLANTED_SOLVE                                                                \
  static void solve(const conebench_problem* problem, const conebench_value* values, \
                    const conebench_stop* stop, const conebench_host* host,          \
                    conebench_result* result);                                       \
  const conebench_plugin* conebench_plugin_entry(void) {                             \
    static const conebench_plugin plugin = {sizeof(conebench_plugin),                \
                                            CONEBENCH_ABI_VERSION,                   \
                                            "planted",                               \
                                            "does harm",                             \
                                            NULL,                                    \
                                            0,                                       \
                                            NULL,                                    \
                                            solve};                                  \
    return &plugin;                                                                  \
  }                                                                                  \
  static void solve(const conebench_problem* problem, const conebench_value* values, \
                    const conebench_stop* stop, const conebench_host* host,          \
                    conebench_result* result)

/* Ends a solve with r as it stands for an answer. */
#define PLANTED_ANSWER(word)              \
  result->r_size = (size_t)problem->rows; \
  result->status = word

#endif
