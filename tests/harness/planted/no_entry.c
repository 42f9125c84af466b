/* A library, and no solver. */
int conebench_plugin_is_missing(void);
int conebench_plugin_is_missing(void) { return 1; }
