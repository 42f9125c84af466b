#pragma once

// Internal to solvers/siconos.cpp: all that it asks of Siconos, in words of our own.

#include <span>

#include "problems/sparse.h"

namespace conebench::solvers {

enum class SiconosSolver {
  kNsgs,     ///< Gauss-Seidel, local Newton with a projection where that fails (the default)
  kNsgsPli,  ///< Gauss-Seidel, local projection iteration
  kNsnAc,
  kNsnFb,
  kViEg,
  kProx,
  kAclmFp,
  kAdmm,
  kSoclcp,
};

/// When Gauss-Seidel computes its error.
enum class SiconosError {
  kFull,   ///< after every sweep
  kLight,  ///< the change of r after every sweep, the error itself at the end
};

struct SiconosSettings {
  SiconosSolver solver = SiconosSolver::kNsgs;
  SiconosError error = SiconosError::kFull;  ///< Gauss-Seidel only
  double tol = 1e-8;                         ///< on Siconos' own error
  int max_iterations = 1000;
};

/// u = W r + q in nc cones of one dimension, 3 (or 2: kNsgs only), Coulomb's law.
struct SiconosProblem {
  const problems::SparseMatrix& W;
  const Eigen::VectorXd& q;
  const Eigen::VectorXd& mu;
  int dim = 3;
};

/// What Siconos says of its run.
struct SiconosAnswer {
  double build_s = 0.0;  ///< its own structures from ours
  double drive_s = 0.0;  ///< its driver
  int info = 0;          ///< 0: its own test was met
  int iterations = 0;
  bool finished = false;  ///< the driver has returned
};

/// Solves from r, in place. May abort, exit, or never return: call it in a child process.
void run_siconos(const SiconosProblem& problem, const SiconosSettings& settings,
                 std::span<double> r, SiconosAnswer& answer);

}  // namespace conebench::solvers
