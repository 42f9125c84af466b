#pragma once

#include "solvers/method.h"

namespace conebench::solvers {

/// Nonlinear Gauss-Seidel: one cone after another, each solved with all others held.
///
/// A sweep does, for each cone i in order, with u_i the rate at the current r,
///
///   q_i = u_i - B_i r_i,   r_i <- (1 - omega) r_i + omega local(B_i, q_i),   [projected if
///   omega != 1]
///
/// where B_i = sym(W_ii), plus regularization lambda_i I where its smallest eigenvalue is below
/// regularization lambda_i: with the same B_i in q_i, fixed points stay exact solutions.
/// local = exact: the one-cone problem solved to rounding (solvers/local/exact.h).
/// local = projection: r_i <- P_K(r_i - u_hat_i / lambda_i), one projected step.
///
/// Forms   velocity: mass-scaled velocities are updated in place; cost of a cone = its few bodies
/// or
///         nodes. Needs a block-diagonal M. delassus: rows of W times r. auto takes the first that
///         is possible.
/// Own test (StopTest::kOwn)  eta itself, computed inside the clock, but only once a sweep has
/// moved
///         no reaction by more than tol U as a rate, and then at growing intervals.
/// Memory  d = 3, two rigid bodies: 288 bytes of blocks and about 250 of local data a cone.
/// No convergence proof for Coulomb friction; the residual judges.
/// Source  Jourdan, Alart, Jean, CMAME 155 (1998) 31-47 (not checked); local step: our derivation.
Method gauss_seidel();

/// Bytes that one sweep of the velocity form with local=exact must read or write, each once: blocks
/// and indices, local data, r, w and y. Precondition: M is block diagonal.
std::size_t gauss_seidel_sweep_bytes(const problems::Problem& problem);

}  // namespace conebench::solvers
