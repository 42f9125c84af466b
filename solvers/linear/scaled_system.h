#pragma once

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

class GeneralSystem;
class KktSystem;
class NormalSystem;

/// The linear system of an interior point, (I + R C W R^T) y = z, with block diagonal scalings R
/// that grow and shrink without bound and C = I, or near it.
///
/// What is factorised is I + R C W R^T + delta R R^T = L (I + S C W S^T) L^T with S = L^-1 R and
/// L L^T = I + delta R R^T, delta_i = 1e-13 lambda_i: W regularised by delta, whose scalings S stay
/// below 1 / delta. Callers refine against W itself.
class ScaledSystem {
 public:
  enum class Form {
    kAuto,    ///< the one with fewer nonzeros; kKkt for good once be_finer() was asked for
    kNormal,  ///< M + H^T S^T S H, or I + S W S^T in the reduced form (linear/normal_system.h)
    kKkt,     ///< [M, H^T S^T; S H, -I], quasidefinite (linear/kkt_system.h); primal form only
  };

  /// `symmetric`: C = I. Otherwise C_i = I + e_n c_i^T, c_i tangential: the same symmetric factor
  /// and GMRES for t_i = c_i.(W R^T y)_i, one unknown a cone, to a looser residual; be_finer() puts
  /// LU of the whole (linear/general_system.h) in their place.
  ScaledSystem(const problems::Problem& problem, Form form, bool symmetric);
  ~ScaledSystem();

  /// The finer form from here on, if there is one. Symmetric: the quasidefinite form, since near
  /// the solution the normal equations lose what scalings, very large on some cones and very small
  /// on others, make cancel. Otherwise LU.
  bool can_be_finer() const;
  void be_finer();

  /// False where there is no factor in doubles.
  bool factorize(const BlockDiagonal& R, const BlockDiagonal& C);
  Eigen::VectorXd solve(Eigen::VectorXd z) const;

  /// The relative residual above which solve() has failed, and that below which no refinement is
  /// worth its cost.
  double fine() const;
  double refined() const;

  /// Of factorize() and a few solve() (Iteration::work_s).
  double work_s() const;

 private:
  Eigen::VectorXd solve_symmetric(const Eigen::VectorXd& z) const;
  Eigen::VectorXd solve_sliding(const Eigen::VectorXd& z) const;
  Eigen::VectorXd slide(const Eigen::VectorXd& z) const;
  Eigen::VectorXd kick(const Eigen::VectorXd& t) const;

  const problems::Problem& problem_;
  bool symmetric_;
  BlockDiagonal identity_, C_, L_, S_, SC_;
  bool may_switch_ = false;
  std::unique_ptr<NormalSystem> normal_;
  std::unique_ptr<KktSystem> kkt_;
  std::unique_ptr<GeneralSystem> general_;
};

}  // namespace conebench::solvers
