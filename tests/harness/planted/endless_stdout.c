#include <stdio.h>

#include "planted.h"

PLANTED_SOLVE {
  for (;;) {
    puts("{\"records\": []}");
    fputs("and no end of it\n", stderr);
  }
}
