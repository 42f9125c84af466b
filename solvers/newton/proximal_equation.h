#pragma once

#include <memory>

#include "solvers/linear/general_system.h"
#include "solvers/newton/cone_function.h"
#include "solvers/newton/line_search.h"
#include "solvers/newton/newton.h"

namespace conebench::solvers {

/// The semismooth equation of a proximal step of the Coulomb problem, and Newton's steps on it:
/// with centre c, p = lambda r and one function of solvers/newton/cone_function.h a cone,
///
///   Phi(p, u(r) + alpha lambda (r - c)) = 0,   (A + B (W + alpha lambda)) dr = -Phi,
///   A_i = lambda_i dphi_i/dp,   B_i = dphi_i/du.
///
/// alpha = 0, or c = r, is the problem as posed. dr is a direction of descent of |Phi|^2 / 2, and u
/// is linear along it: one product with W.
class ProximalEquation {
 public:
  /// `settings`: function, form, rho. `problem` must outlive this.
  ProximalEquation(const problems::Problem& problem, const NewtonSettings& settings);

  /// Moves to r and makes it the centre.
  void start(const Eigen::VectorXd& r, double alpha);
  /// Makes the iterate the centre: merit() is then that of the problem as posed.
  void recentre();
  /// The weight from here on. Precondition: the iterate is the centre.
  void set_alpha(double alpha) { alpha_ = alpha; }
  /// One Newton step, as long as `lengths` says; its length, or nothing, and no move, where the
  /// matrix is singular or no length is acceptable. Costs an LU factorisation and two products with
  /// W.
  std::optional<double> step(StepLength& lengths);

  const Eigen::VectorXd& r() const { return r_; }
  const Eigen::VectorXd& u() const { return u_; }  ///< W r + q
  double merit() const { return 0.5 * phi_.squaredNorm(); }
  /// Of the latest step (Iteration::work_s).
  double step_work_s() const { return work_s_; }

 private:
  const problems::Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }
  void move_to(const Eigen::VectorXd& r);
  void evaluate(const Eigen::VectorXd& p, const Eigen::VectorXd& u, Eigen::VectorXd& phi) const;
  void linearise();
  bool find_direction();

  const problems::Problem& problem_;
  std::unique_ptr<const ConeFunction> function_;
  Eigen::VectorXd lambda_;  // one entry a row
  GeneralSystem system_;
  BlockDiagonal A_, B_, regularised_;  // the last: A + alpha B lambda
  double alpha_ = 0.0, work_s_ = 0.0;
  Eigen::VectorXd centre_;
  Eigen::VectorXd r_, p_, u_, phi_;  // at the iterate; p = lambda r
  Eigen::VectorXd pulled_;           // u + alpha lambda (r - c)
  Eigen::VectorXd dr_, dp_, du_;     // along the step; du of the pulled rate
  double slope_ = 0.0;
  Eigen::VectorXd trial_;
};

}  // namespace conebench::solvers
