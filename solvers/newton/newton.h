#pragma once

#include "solvers/iteration.h"
#include "solvers/linear/general_system.h"
#include "solvers/newton/line_search.h"

namespace conebench::solvers {

struct NewtonSettings {
  enum class Function { kAlartCurnier, kJeanMoreau, kFischerBurmeister };

  Function function = Function::kAlartCurnier;
  LineSearch line_search = LineSearch::kNonMonotone;
  GeneralSystem::Form form = GeneralSystem::Form::kAuto;
  double rho = 1.0;              ///< of Alart-Curnier, in units of 1 / lambda_i [-], > 0
  double regularisation = 1e-6;  ///< alpha of the first step [-], >= 0
  std::int64_t warmup = 0;       ///< sweeps of Gauss-Seidel first, each an iteration
};

/// Semismooth Newton on Phi(r, u(r)) = 0, one function of solvers/newton/cone_function.h a cone:
/// with p = lambda r, so that Phi is in rates whatever the cone's size,
///
///   (A + B (W + alpha lambda)) dr = -Phi,   A_i = lambda_i dphi_i/dp,  B_i = dphi_i/du,
///   r <- r + t dr.
///
/// alpha = 0 is Newton's method. alpha > 0 is one Newton step on the proximal point problem with
/// centre r, u(x) + alpha lambda (x - r) in the place of u(x): regular where W is singular, and
/// with the same solutions as fixed points. t is found on the merit |Phi|^2 / 2 of that problem,
/// for which dr is the Newton direction, along which u is linear: one product with W.
/// alpha falls when t >= 1/2, faster when |Phi|^2 itself falls, grows (from 0 it does not) when t
/// is short, and rises with r kept when the matrix is singular or no t is acceptable.
///
/// Cost    an advance() is one sparse LU factorisation and two products with W.
/// Stalls  when no alpha up to 100 gives an acceptable step.
/// No convergence proof from afar: W may be singular and the problem is not convex.
/// Source  Acary, Bremond, Huber, RR-9118 (2017), NSN-AC, and PPA-NSN for the proximal term, which
///         there is solved to a tolerance before the centre moves (not checked).
std::unique_ptr<Iteration> make_newton(const problems::Problem& problem,
                                       const NewtonSettings& settings);

/// newton-ac and newton-fb.
Method alart_curnier_newton();
Method fischer_burmeister_newton();

}  // namespace conebench::solvers
