#include <signal.h>

#include "planted.h"

__attribute__((constructor)) static void crash(void) { raise(SIGSEGV); }

PLANTED_SOLVE { PLANTED_ANSWER(CONEBENCH_STALLED); }
