#pragma once

#include "solvers/registry.h"

namespace conebench::solvers {

/// The same problem under the associated law, theta = 0 in every cone: a convex problem, in which
/// sliding opens a contact at mu times its speed. Keeps rate_scale(), so that its eta and that of
/// the problem as posed are shares of the same violation. Primal form: M is factorised again.
problems::Problem associated_problem(const problems::Problem& problem);

/// `ccp`, a model: the cone complementarity problem of Anitescu and Tasora, which is
/// associated_problem(), solved by one of our methods: `method` = ipm (the surest on real problems,
/// to an own eta of 1e-8 or 1e-9), aclm (solvers/ssnal.h for the shift 0, to rounding), spg or gs.
/// Converged means eta <= tol of that problem; its eta in the problem as posed is the model's gap.
/// Exact where theta = 0 already.
/// Errors, cost, refusals  those of the method; set-up includes posing the problem.
/// Source  Anitescu, Tasora, Comput. Optim. Appl. 47(2) (2010) 207-235 (not checked).
Method cone_complementarity_model();

}  // namespace conebench::solvers
