#pragma once

// A folder that breaks the rules, so that the layering test is seen to fail.
#include "solvers/solver.h"
