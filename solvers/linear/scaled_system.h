#pragma once

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

class GeneralSystem;
class KktSystem;
class NormalSystem;
class SlidingSystem;

/// The linear system of an interior point, (I + R C W R^T) y = z, with block diagonal scalings R
/// that grow and shrink without bound and C = I, or near it.
///
/// What is factorised is I + R C W R^T + delta R R^T = L (I + S C W S^T) L^T with S = L^-1 R and
/// L L^T = I + delta R R^T, delta_i = 1e-13 lambda_i: W regularised by delta, whose scalings S stay
/// below 1 / delta. Callers refine against W itself.
class ScaledSystem {
 public:
  enum class Form {
    kAuto,    ///< the one with fewer nonzeros; the finer one once be_finer() was asked for
    kNormal,  ///< M + H^T S^T S C H (linear/normal_system.h, linear/sliding_system.h), or
              ///< I + S C W S^T in the reduced form
    kKkt,     ///< [M, H^T S^T; S H, -I], quasidefinite (linear/kkt_system.h); primal form only
  };

  /// `symmetric`: C = I. Otherwise C_i = I + e_n c_i^T, c_i tangential, and LU in place of
  /// Cholesky; in place of the quasidefinite form that of linear/general_system.h.
  ScaledSystem(const problems::Problem& problem, Form form, bool symmetric);
  ~ScaledSystem();

  /// The finer form from here on, if there is one: not the normal equations, which near the
  /// solution lose what scalings, very large on some cones and very small on others, make cancel.
  bool can_be_finer() const { return may_switch_; }
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
  const problems::Problem& problem_;
  bool symmetric_, may_switch_;
  BlockDiagonal identity_, L_, S_, SC_;
  // One of them is there.
  std::unique_ptr<NormalSystem> normal_;
  std::unique_ptr<KktSystem> kkt_;
  std::unique_ptr<SlidingSystem> sliding_;
  std::unique_ptr<GeneralSystem> general_;
};

}  // namespace conebench::solvers
