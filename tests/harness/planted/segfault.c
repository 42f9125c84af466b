#include "planted.h"

PLANTED_SOLVE {
  volatile int* nowhere = NULL;
  *nowhere = 1;
}
