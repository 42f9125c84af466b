#include <math.h>

#include "planted.h"

PLANTED_SOLVE {
  result->r[0] = NAN;
  PLANTED_ANSWER(CONEBENCH_CONVERGED);
}
