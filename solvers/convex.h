#pragma once

#include "solvers/cone_vectors.h"
#include "solvers/iteration.h"

namespace conebench::solvers {

/// The convex problem inside the fixed point of Cadoux (solvers/aclm.h): for a given shift t, one
/// t_i >= 0 [rate_unit] a cone, find r with
///
///   u = W r + q,   K_mu* contains u_i + t_i e_n,   orthogonal to   r_i in K_mu;
///
/// in the primal form: min 1/2 v.Mv - f.v  subject to  H v + w + t e_n in K*. Convex for every t;
/// t = 0 is the associated problem.
class ConvexIteration {
 public:
  virtual ~ConvexIteration() = default;

  /// Poses the problem with this shift and starts at r; what was factorised may be kept.
  virtual void pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) = 0;
  /// One iteration towards error() <= tolerance.
  virtual Iteration::State advance(double tolerance) = 0;
  /// r in K (interior or boundary), and u = W r + q at it.
  virtual const Eigen::VectorXd& r() const = 0;
  virtual const Eigen::VectorXd& u() const = 0;
  /// max_i lambda_i |r_i - P_K(r_i - (u_i + t_i e_n) / lambda_i)| / U at r(): eta of the posed
  /// problem.
  virtual double error() const = 0;
  /// Iteration::work_s of one advance().
  virtual double step_work_s() const { return 0.0; }
  virtual std::vector<std::string> notes() const { return {}; }
};

using MakeConvex = std::function<std::unique_ptr<ConvexIteration>(const problems::Problem&)>;

/// theta_i |u_it|, one entry a cone: the shift whose convex problem has the Coulomb problem's
/// solutions as fixed points. With it, convex_error is eta.
Eigen::VectorXd de_saxce_shift(const problems::Problem& problem, const Eigen::VectorXd& u);

/// error() for given r and u = W r + q.
double convex_error(const problems::Problem& problem, const Eigen::VectorXd& shift,
                    const Eigen::VectorXd& r, const Eigen::VectorXd& u);

}  // namespace conebench::solvers
