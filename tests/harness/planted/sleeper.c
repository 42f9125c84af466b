#include <unistd.h>

#include "planted.h"

PLANTED_SOLVE {
  for (;;) pause();
}
