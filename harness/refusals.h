#pragma once

#include <string>
#include <vector>

#include "problems/problem.h"
#include "solvers/registry.h"

namespace conebench::harness {

/// A problem of some kind, for asking solvers whether they take it.
struct ProblemKind {
  std::string name;  ///< "cones of d = 6"
  problems::Problem problem;
};

/// One of each kind that some solver might refuse: dimensions, laws, forms, masses, sizes. Their
/// data are only good for asking.
std::vector<ProblemKind> kinds_of_problems();

/// What a method does not take.
struct Refusal {
  std::string kind;       ///< of problem
  std::string parameter;  ///< "form=full", where another value than the default makes it so
  std::string reason;     ///< in the solver's words
};

/// Asks the method about every kind, with its defaults and with every other choice of each text
/// parameter; of those, only answers that differ from the default's are given.
std::vector<Refusal> refusals_of(const solvers::Method& method,
                                 const std::vector<ProblemKind>& kinds);

}  // namespace conebench::harness
