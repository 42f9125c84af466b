#pragma once

#include <functional>
#include <vector>

#include "problems/problem.h"

namespace conebench::solvers {

/// A smooth program over second-order cones, as data: find x that minimises
///
///   1/2 x.Q x + c.x   subject to  A x = b,   lower <= x <= upper,
///   g_i(x) = y - |x_t|^2 / (y + eps) >= 0  with  y = mu_i x_n >= 0.
///
/// For eps -> 0 the last line says |x_t| <= mu_i x_n, and -log g_i - log y is the cone's
/// self-concordant barrier -log(y^2 - |x_t|^2). eps > 0 gives g_i a gradient at the tip, where
/// every open contact sits, and lets |x_t| exceed mu_i x_n by at most eps / 2.
/// Units   none: its maker scales.
/// Source  Vanderbei, Yurttan, "Using LOQO to solve second-order cone programming problems" (1998)
///         for y - |x|^2 / y (not checked); eps is ours.
struct ConeProgram {
  /// x_n = x(normal), x_t = x[tangent, tangent + dim), dim >= 1.
  struct Cone {
    int normal = 0, tangent = 0, dim = 1;
    double mu = 0.0;
  };

  problems::SparseMatrix Q;  ///< lower triangle of the symmetric matrix
  Eigen::VectorXd c;
  problems::SparseMatrix A;
  Eigen::VectorXd b;
  Eigen::VectorXd lower, upper;  ///< infinite where there is none; lower(x_n) >= 0
  std::vector<Cone> cones{};
  double eps = 1e-12;  ///< > 0

  int variables() const { return static_cast<int>(c.size()); }
  int constraints() const { return static_cast<int>(b.size()) + static_cast<int>(cones.size()); }
};

/// Where Ipopt starts, and where it ended.
struct ProgramPoint {
  Eigen::VectorXd x;
  Eigen::VectorXd constraint_dual{};           ///< A's rows, then the cones; empty: none known
  Eigen::VectorXd lower_dual{}, upper_dual{};  ///< one a variable
};

struct IpoptRun {
  double tol = 1e-8;      ///< on Ipopt's own scaled optimality error [-]
  double barrier = 10.0;  ///< the first barrier parameter [-]
  int max_iterations = 200;
};

enum class IpoptEnd {
  kSolved,
  kStopped,  ///< the watcher said so
  kFailed,   ///< any other end: iteration limit, local infeasibility, restoration failed, a NaN
};

/// Called once an iteration, the starting point being iteration 0 of each run; false stops. In
/// Ipopt's restoration phase x is the last iterate before it.
using Watch = std::function<bool(const Eigen::VectorXd& x)>;

/// One run of Ipopt (interior point with a filter, MUMPS, exact Jacobian and Hessian), silent and
/// blind to option files. `point` is the start, with its duals a warm one, and then the end.
/// Errors  what `watch` throws.
/// Source  Waechter, Biegler, Math. Program. 106(1) (2006) 25-57 (not checked).
IpoptEnd run_ipopt(const ConeProgram& program, const IpoptRun& run, ProgramPoint& point,
                   const Watch& watch);

}  // namespace conebench::solvers
