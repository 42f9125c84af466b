#include "planted.h"

PLANTED_SOLVE {
  PLANTED_ANSWER(CONEBENCH_CONVERGED);
  --result->r_size;
}
