#include <stdlib.h>

#include "planted.h"

PLANTED_SOLVE { abort(); }
