/* Deaf to every signal that can be ignored, and busy. */
#include <signal.h>

#include "planted.h"

PLANTED_SOLVE {
  volatile int busy = 1;
  int number;
  for (number = 1; number < NSIG; ++number) signal(number, SIG_IGN);
  while (busy) {
  }
}
