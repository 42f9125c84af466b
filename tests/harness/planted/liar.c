/* Says of where it started that it is a solution. */
#include "planted.h"

PLANTED_SOLVE { PLANTED_ANSWER(CONEBENCH_CONVERGED); }
