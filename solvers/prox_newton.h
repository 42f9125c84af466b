#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// Proximal Newton: the proximal step of solvers/ssnal.h on the Coulomb problem itself, where
/// t = theta |u_t| follows u. From a centre c, semismooth Newton on
///
///   F(r) = P_K( c - sigma (u(r) + theta |u_t(r)| e_n) ) - r = 0,   sigma_i = 1 / (alpha lambda_i).
///
/// With N_i = theta_i e_n (0, u_it / |u_it|)^T, 0 where u_it = 0, a step solves (I + E (I + N) W)
/// dr = F with E_i = sigma_i dP_K. For a given change of t that is the symmetric system of
/// linear/normal_system.h; GMRES, one solve() of it an iteration and usually fewer than ten, finds
/// that change, one entry a cone. The step's length is found by bisection on F.W dr, the slope of
/// ssnal's merit function were t fixed (solvers/slope_search.h): no merit function of this problem,
/// so that steps can cycle; then alpha grows.
///
/// Newton converges from where eta / alpha is small, and a solved proximal step leaves eta near
/// alpha times its length. So alpha starts at 3 eta, falls after every solved step, more after an
/// easy one, and grows fourfold, from the best iterate, where 10 Newton steps were not enough.
/// Stalls when that has happened 5 times in a row. No proof: F has none of the convexity above.
///
/// One iteration is one Newton step: a factorisation, the GMRES iterations, a product with W.
/// Source  ours; Newton inside a proximal point is RR-9118's PPA-NSN (solvers/newton/newton.h).
std::unique_ptr<Iteration> make_proximal_newton(const problems::Problem& problem);

/// `prox-newton`: the same as a solver. Refuses W = 0.
Method proximal_newton();

}  // namespace conebench::solvers
