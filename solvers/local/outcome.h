#pragma once

namespace conebench::solvers {

/// What became of a one-cone solve.
enum class LocalOutcome {
  kDone,
  kStopped,     ///< a Newton kept its best iterate, short of a solution; the quartic left r alone
  kNoSolution,  ///< no reaction satisfies the law; r is left as it was
};

}  // namespace conebench::solvers
