#pragma once

#include "solvers/method.h"
#include "solvers/variant_text.h"

namespace conebench::solvers {

/// How a variant that names a program begins: "exec:./my_solver.py".
inline constexpr std::string_view kExternalPrefix = "exec:";

/// A program in any language as a peer (examples/README.md states the protocol). It is called as
///
///   PROGRAM problem.h5 solution.h5 --tol T --time-limit S [--KEY VALUE]...
///
/// in which problem.h5 is the standard problem, in a folder that is gone afterwards; it writes
/// /solution/r and exits with 0 if it claims convergence, 1 if not. At the time limit it is killed,
/// with all that it has started. No answer, a wrong one or a crash is kDiverged with a note.
/// "exec:PROGRAM[key=value]" adds --key value; which keys there are only the program knows.
///
/// Clock  set-up: writing the problem; solve: the whole run of the program.
/// Errors  InputError when there is no such executable file, or for a key of the protocol's own.
std::vector<Solver> make_external_solvers(const VariantText& variants);

}  // namespace conebench::solvers
