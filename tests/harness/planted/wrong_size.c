/* Of this version, by its word, but of another size: only the first two members are there. */
#include "planted.h"

const conebench_plugin* conebench_plugin_entry(void) {
  static const struct {
    size_t struct_size;
    uint32_t abi_version;
  } plugin = {sizeof plugin, CONEBENCH_ABI_VERSION};
  return (const conebench_plugin*)&plugin;
}
