#pragma once

#include "solvers/convex.h"
#include "solvers/linear/scaled_system.h"
#include "solvers/nt_scaling.h"

namespace conebench::solvers {

/// Our primal-dual interior point for second-order cones: Nesterov-Todd scaling in closed form,
/// Mehrotra's predictor and correctors. 10 to 30 iterations, one factorisation each (two where it
/// changes to the finer system).
///
/// Iterates  r in int K, x in int K*, with M v = f + H^T r kept exactly (u = W r + q), so that one
///           residual, e = u + t e_n - x, and the gap r.x are driven to zero. r_t of cones with
///           mu = 0 is 0. Entries of e below the rounding in u count as zero.
/// Step      in scaled directions dx~ = R dx, dr = R^T dr~ (R: solvers/nt_scaling.h), dx = W dr + e
///           and dr~ + dx~ = z give (I + R W R^T) dr~ = z - R e (solvers/linear/scaled_system.h),
///           refined against W itself: affine, which could go the share `step`; then towards
///           sigma nu, sigma = (1 - step)^3, with e reduced by 1 - sigma and step^2 of Mehrotra's
///           second-order term, so that a blocked direction turns into pure centring; then up to 4
///           times more, each with the second-order term of the direction before, while that goes
///           further. They cost a solve each, and save a third of the factorisations.
/// Start     from (r, u): z = r - (u + t e_n) / lambda splits into r = P_K(z), x = lambda (r - z),
///           both pushed into the interior along e_n by ten times their violation; with `coulomb`
///           moved to where rho o xi = (start U)^2 / lambda e (solvers/central_pair.h), lambda
///           floored: from there a guess saves iterations, and the path is lost less often.
/// Accuracy  where r_i = x_i = 0 for some cone, error() is the square root of the gap: 1e-8 to 1e-9
///           is what doubles allow. It can stall elsewhere too: in results/published/methods.md
///           `aclm-ipm` leaves 2 of 30 ordinary problems at an eta between 1e-8 and 2e-6, one of
///           the two at such a cone, `ipm` one.
///
/// With `coulomb` the shift is no longer given: x = u + theta |u_t|_eps e_n, |a|_eps = sqrt(|a|^2 +
/// eps^2), is the De Saxce term as an unknown, so that dx = C W dr + e with C_i = I + theta e_n
/// (u_t / |u_t|_eps)^T, and the system is not symmetric: LU. eps shrinks with the gap: eps_i = s
/// sqrt(nu lambda_i) min(1, sqrt(nu lambda_i) / U), nu the mean gap of a cone, s = 0.1 unless said
/// otherwise; with s = 1 it takes twice the iterations, and is trapped less often. A step is
/// halved, up to 8 times, until it lowers e or keeps it below the gap. Where less than 0.3 of a
/// step is possible, the shift is held for one iteration (C = I): its own steps, near a fold of the
/// path to the solution, may become arbitrarily short.
///
/// Source  Nesterov & Todd, SIAM J. Optim. 8(2) (1998); Mehrotra, SIAM J. Optim. 2(4) (1992); the
///         De Saxce term as an unknown: an idea of Acary, Armand, Nguyen, Shpakovych (2022) (none
///         checked; smoothing and globalisation are ours).
class InteriorPoint final : public ConvexIteration {
 public:
  InteriorPoint(const problems::Problem& problem, ScaledSystem::Form form, bool coulomb);

  void pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) override;
  Iteration::State advance(double tolerance) override;
  const Eigen::VectorXd& r() const override { return r_; }
  const Eigen::VectorXd& u() const override { return u_; }
  double error() const override { return error_; }
  double step_work_s() const override;

  /// With the Coulomb shift of the iterate itself.
  double eta() const;
  void smooth(double share) { smoothing_share_ = share; }  ///< s of eps_i, from pose() on
  void start_at(double share) { start_ = share; }          ///< of U: what pose() begins with
  double smoothing() const { return smoothing_; }          ///< largest eps [rate_unit]
  double gap() const { return nu_; }                       ///< r.x / cones

 private:
  struct Direction {
    Eigen::VectorXd dr, du, dx;            // du = W dr
    Eigen::VectorXd scaled_dr, scaled_dx;  // dr~, dx~
  };

  const problems::Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }
  double scale() const { return problem_.rate_scale() > 0.0 ? problem_.rate_scale() : 1.0; }
  double smoothing_of(int i) const;
  double start_mobility(int i) const;

  void centre_cone(int i);
  void push_inside(int i, double share);
  void update();
  void hold_shift();
  Eigen::VectorXd shift_normals() const;
  Eigen::VectorXd residual_above_rounding() const;
  double find_direction(const Eigen::VectorXd& residual, bool shift_held);
  bool affine_direction(const Eigen::VectorXd& residual);
  double direction(const Eigen::VectorXd& residual, double target, double correction);
  double to_boundary() const;
  double step_length(double longest) const;
  void keep_inside();
  double shorten(double step, double share, double before) const;

  const problems::Problem& problem_;
  bool coulomb_;
  double least_mobility_;  // at a start
  ScaledSystem system_;
  BlockDiagonal R_, C_;
  NtScalings scalings_;
  Eigen::VectorXd posed_;      // t
  Eigen::VectorXd r_, x_, u_;  // x -> u + t e_n
  Direction direction_;        // the latest
  int directions_ = 1;         // looked for in the latest advance()
  double nu_ = 0.0;            // r.x / cones
  double start_ = 1.0, smoothing_share_ = 0.1;
  double smoothing_ = 0.0;  // largest eps
  double error_ = 0.0;
};

}  // namespace conebench::solvers
