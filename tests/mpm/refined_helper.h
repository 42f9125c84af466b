#pragma once

#include "tests/mpm/engine_helper.h"

namespace conebench::test {

/// A dense block inside an open grid, disturbed, moving and turning: inside whole cells, outside
/// halves, nodes that hang between them.
mpm::Scene heap(int dim);

/// Fails unless there are particles in whole cells and on halves beside them.
void expect_both_kinds(const mpm::Nodes& nodes);

}  // namespace conebench::test
