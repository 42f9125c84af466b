#pragma once

#include "solvers/convex.h"

namespace conebench::solvers {

/// Which linear system an interior point method factorises.
enum class IpmForm {
  kAuto,    ///< the one with fewer nonzeros; kKkt for good once kNormal has lost its accuracy
  kNormal,  ///< M + H^T R^T R H, or I + R W R^T in the reduced form (linear/normal_system.h)
  kKkt,     ///< [M, H^T R^T; R H, -I], quasidefinite (linear/kkt_system.h); primal form only
};

/// Our primal-dual interior point for second-order cones: Nesterov-Todd scaling in closed form,
/// Mehrotra's predictor and corrector.
///
/// Iterates  r in int K, x in int K*, with M v = f + H^T r kept exactly (u = W r + q), so that one
///           residual, e = u + t e_n - x, and the gap r.x are driven to zero. r_t of cones with
///           mu = 0 is 0.
/// Step      in scaled directions dx~ = R dx, dr = R^T dr~, R_i = N_i^-1 T_i
/// (solvers/nt_scaling.h),
///           dx = W dr + e and dr~ + dx~ = z give (I + R W R^T) dr~ = z - R e: one factorisation,
///           two solves: affine, which could go the share `step`; then towards sigma nu,
///           sigma = (1 - step)^3, with e reduced by 1 - sigma and step^2 of Mehrotra's
///           second-order term, so that a blocked direction turns into pure centring. Each is
///           refined against W itself where that helps.
/// Start     from (r, u): z = r - (u + t e_n) / lambda splits into r = P_K(z) and x = lambda (r -
/// z),
///           both pushed into the interior along e_n by ten times their violation.
///
/// As a ConvexIteration: t is given (associated problem, inner method of aclm-ipm).
/// Cost    a few Cholesky factorisations of fixed pattern an iteration: 15 to 40 iterations.
/// Source  Nesterov & Todd, SIAM J. Optim. 8(2) (1998); Mehrotra, SIAM J. Optim. 2(4) (1992)
///         (neither checked); Vanderbei for the quasidefinite form.
std::unique_ptr<ConvexIteration> make_interior_point(const problems::Problem& problem,
                                                     IpmForm form);

/// `ipm`: the same iteration with the De Saxce term as an unknown. x = u + theta |u_t|_eps e_n with
/// |a|_eps = sqrt(|a|^2 + eps^2), so that dx = C W dr + e, C_i = I + theta e_n (u_t / |u_t|_eps)^T,
/// and I + R C W R^T is not symmetric (linear/general_system.h). eps shrinks with the gap:
/// eps_i = sqrt(nu lambda_i) min(1, sqrt(nu lambda_i) / U), nu the mean gap of a cone; its last
/// value is in the notes. A step is shortened until it lowers the residual e or keeps it below the
/// gap. No convergence proof: the problem is not convex. For theta = 0 it is the convex method.
/// Best iterate kept. Where gap and eta stop falling (the trap of false convergence: gap closed,
/// eta not small), or a factorisation fails, it goes on as aclm-ipm from its best iterate and says
/// so. Source  Acary, Armand, Nguyen, Shpakovych (2022), the idea of s as an unknown (not checked;
/// the
///         smoothing and the globalisation are ours).
Method interior_point();
std::unique_ptr<Iteration> make_ipm(const problems::Problem& problem);

/// `aclm-ipm`: make_interior_point inside the fixed point of solvers/aclm.h.
Method aclm_interior_point();

}  // namespace conebench::solvers
