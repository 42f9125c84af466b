#pragma once

#include "problems/problem.h"

namespace conebench::solvers {

/// Vectors with one part a cone, as first-order methods use them, in the metric of lambda_i (a
/// reaction times its lambda_i is a rate). Precondition: rows() entries. Nothing here allocates but
/// mobility_per_row().

/// lambda_i on each row of cone i.
Eigen::VectorXd mobility_per_row(const problems::Problem& problem);

/// Replaces each r_i by its projection on K_mu.
void project_on_cones(const problems::Problem& problem, Eigen::VectorXd& r);

/// Turns u into u_hat: adds theta_i |u_it| to each u_in.
void add_de_saxce(const problems::Problem& problem, Eigen::VectorXd& u);

/// max_i lambda_i |r_i| [rate_unit].
double size_as_rate(const problems::Problem& problem, const Eigen::VectorXd& r);

/// Shares of size_as_rate(r): a step below the first is rounding, not progress; what a step below
/// the second changes in u is rounding, and says nothing of the next step's length.
inline constexpr double kNoProgress = 1e-16, kTooSmallToMeasure = 1e-13;

}  // namespace conebench::solvers
