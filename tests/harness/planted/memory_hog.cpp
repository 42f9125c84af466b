// Takes memory without end and uses it, so that the system cannot lend it for nothing.
#include <vector>

#include "planted.h"

PLANTED_SOLVE {
  std::vector<std::vector<double>> kept;
  for (;;) kept.emplace_back(1 << 20, 1.0);
}
