#include <unistd.h>

#include "planted.h"

__attribute__((constructor)) static void hang(void) {
  for (;;) pause();
}

PLANTED_SOLVE { PLANTED_ANSWER(CONEBENCH_STALLED); }
