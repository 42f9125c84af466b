#pragma once

#include "problems/problem.h"

namespace conebench::problems {

/// One quantity over all cones (or dofs): |.| is the Euclidean norm of one cone's part.
struct Measure {
  double max = 0.0;
  double rms = 0.0;
  Eigen::VectorXd per_cone;  ///< cones entries (momentum: dofs)
};

/// How far r' is from a solution of the *standard* problem. The one yardstick for every solver;
/// a solver's own estimate may steer it but is never published. Everything is recomputed from
/// (r', problem): v = M^-1 (f' + H^T r'), u = H v + w, u_hat = u + theta |u_t| e_n.
///
/// A residual is not an error bound: the problem is not convex.
struct Residual {
  /// eta_i = lambda_i |r'_i - P_K(r'_i - u_hat_i / lambda_i)| / U  [-]; eta.max decides success.
  Measure eta;
  /// About 1e-16 max(lambda_i |r'_i|, | |H_i| |v| |) / U: what cancels in u, in doubles. No method
  /// can promise less, and two evaluations of eta may differ by a few times as much.
  double attainable_eta = 0.0;
  bool finite = true;  ///< false when r' or u holds a NaN or an infinity; then eta.max is infinite

  /// Other programs' stopping tests, for comparison with published figures. All with unit step:
  double fclib = 0.0;    ///< |r' - P_K(r' - u_hat)|_2 / |q'|_2 (RR-9118)
  double siconos = 0.0;  ///< the same over max(|q'|, |r'|, |u|)
  /// So-bogus' tests without its scaling of r: sum over the cones of |phi_i|^2, over 1 + cones,
  /// with phi of Fischer-Burmeister in x = (mu r_n, r_t), y = (u_hat_n, mu u_t), or of
  /// Alart-Curnier.
  double fischer_burmeister = 0.0;
  double alart_curnier = 0.0;

  /// Physical parts.
  Measure penetration_rate;  ///< max(0, -u_n) [rate_unit]
  Measure cone_violation;    ///< max(0, |r'_t| - mu r'_n) [force_unit]
  Measure tension;           ///< max(0, -r'_n): pull beyond the tensile strength [force_unit]
  Measure work;              ///< |r' . u_hat| [force_unit rate_unit]
  Measure misalignment;      ///< angle of r'_t to -u_t [rad] where |u_t| > 10 eta U, else 0
  Measure momentum;          ///< |M v - f' - H^T r'| per dof, primal form only
};

/// Costs one product with W (through M^-1, never formed) and a few passes over the cones.
/// `standard` must have kappa = 0 (Problem::shifted()), r one entry a row; else InputError.
Residual evaluate_residual(const Problem& standard, const Eigen::VectorXd& r);

/// eta alone: the same number as evaluate_residual(standard, r).eta.max, for stopping tests.
double evaluate_eta(const Problem& standard, const Eigen::VectorXd& r);

}  // namespace conebench::problems
