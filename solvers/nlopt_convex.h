#pragma once

#include "solvers/convex.h"

namespace conebench::solvers {

struct NloptSettings {
  enum class Algorithm {
    kSlsqp,   ///< sequential quadratic programming, dense BFGS
    kMma,     ///< method of moving asymptotes
    kCcsaq,   ///< conservative convex separable approximation, quadratic
    kAuglag,  ///< augmented Lagrangian, inner L-BFGS
  };
  Algorithm algorithm = Algorithm::kSlsqp;
};

/// NLopt on the convex problem of solvers/convex.h, in r alone:
///
///   min 1/2 r.W r + (q + t e_n).r   with   |r_it|_eps <= mu_i r_in,   r_in >= 0,
///   |x|_eps = sqrt(|x|^2 + eps^2) - eps,   eps = 1e-10 of U,
///
/// scaled by solvers/dimensionless.h; r is projected on K afterwards. W is never formed: a value
/// and gradient cost one product with it.
///
/// One advance() is one run of NLopt of at most 300 evaluations or 1 s, stopped when error() is
/// small enough; the library's own memory (BFGS matrix, asymptotes) does not survive it. A time
/// limit is seen between runs only.
/// Memory  cones x rows numbers (NLopt's constraint Jacobians are dense), slsqp about 3 rows^2
///         more.
/// Source  Kraft 1988 (slsqp); Svanberg, SIAM J. Optim. 12(2) (2002) 555-573 (mma, ccsaq); Birgin,
///         Martinez, Optim. Methods Softw. 23(2) (2008) (auglag) (none checked).
std::unique_ptr<ConvexIteration> make_nlopt_convex(const problems::Problem& problem,
                                                   const NloptSettings& settings);

/// `nlopt`: make_nlopt_convex inside the fixed point of solvers/aclm.h. Refuses problems of more
/// rows than its algorithm can serve: auglag 1000; slsqp, with O(rows^3) a step, mma and ccsaq,
/// with an inner dual problem of O(cones rows) an evaluation, 300.
Method nlopt();

}  // namespace conebench::solvers
