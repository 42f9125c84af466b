#pragma once

#include <optional>
#include <string_view>

#include "problems/problem.h"

namespace conebench::solvers {

/// How far r is from a solution of what the model `variant` solves: eta with the model's own law,
/// measured against the rate_scale() of the problem as posed [-]. Computed from r, not taken from
/// the solver. The associated law for `ccp` and `siconos:soclcp`, pyramids for `pyramid`; nothing
/// for a solver that is no model of ours, or a problem that the model refuses.
/// Cost: one product with W, and for the associated law a factorisation of M.
std::optional<double> model_residual(std::string_view variant, const problems::Problem& standard,
                                     const Eigen::VectorXd& r);

}  // namespace conebench::solvers
