#include "planted.h"

PLANTED_SOLVE { PLANTED_ANSWER(99); }
