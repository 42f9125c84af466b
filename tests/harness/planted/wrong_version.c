/* Whoever reads more than the first two members crashes. */
#include "planted.h"

#define POISON(type) ((type)16)

const conebench_plugin* conebench_plugin_entry(void) {
  static const conebench_plugin plugin = {sizeof(conebench_plugin),
                                          CONEBENCH_ABI_VERSION + 1,
                                          POISON(const char*),
                                          POISON(const char*),
                                          POISON(const conebench_parameter*),
                                          1000,
                                          NULL,
                                          NULL};
  return &plugin;
}
