/* A parameter whose size is of another version: its name must not be read. */
#include "planted.h"

static void solve(const conebench_problem* problem, const conebench_value* values,
                  const conebench_stop* stop, const conebench_host* host,
                  conebench_result* result) {
  PLANTED_ANSWER(CONEBENCH_STALLED);
}

const conebench_plugin* conebench_plugin_entry(void) {
  static const conebench_parameter parameter = {sizeof(conebench_parameter) - sizeof(void*),
                                                (const char*)16,
                                                CONEBENCH_REAL,
                                                {sizeof(conebench_value), 0, 0, 1.0, NULL},
                                                0.0,
                                                2.0,
                                                NULL,
                                                NULL};
  static const conebench_plugin plugin = {
      sizeof(conebench_plugin), CONEBENCH_ABI_VERSION, "planted", "", &parameter, 1, NULL, solve};
  return &plugin;
}
