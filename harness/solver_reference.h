#pragma once

#include <span>
#include <string>

#include "solvers/registry.h"

namespace conebench::harness {

/// Every method in Markdown: kind, summary, source, each parameter with type, range, default and
/// what it is, and what it refuses, found out by asking (harness/refusals.h). It depends on nothing
/// but the methods, so that two builds with the same ones write the same text; what
/// docs/solvers.md holds. Cost: a second, for the larger problems that it asks about.
std::string solver_reference(std::span<const solvers::Method> methods);

}  // namespace conebench::harness
