#pragma once

#include "solvers/convex.h"

namespace conebench::solvers {

/// Ipopt on the convex problem of solvers/convex.h, in the form
///
///   min 1/2 v.M v + (w + t e_n).r   over v, r   with   M v - H^T r = f,   r_i in K_mu
///
/// (reduced form: min 1/2 r.W r + (q + t e_n).r over r_i in K_mu, W's symmetric part), whose
/// solutions r are those of the dual; cones as in solvers/cone_program.h with eps 1e-14 of U,
/// scaled by solvers/dimensionless.h, exact derivatives.
///
/// One advance() is one run of Ipopt, cold after pose(); then warm, to ever smaller tolerances. A
/// time limit is seen between runs only, of at most 100 iterations each.
/// Cost    an iteration: one sparse symmetric factorisation (MUMPS) of size 2 dofs + rows, or rows.
std::unique_ptr<ConvexIteration> make_ipopt_convex(const problems::Problem& problem);

/// `aclm-ipopt`: make_ipopt_convex inside the fixed point of solvers/aclm.h.
Method aclm_ipopt();

}  // namespace conebench::solvers
