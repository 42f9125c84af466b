#pragma once

#include "solvers/convex.h"

namespace conebench::solvers {

/// The fixed point of Cadoux: freeze the De Saxce term t_i = theta_i |u_it|, solve the convex
/// problem that is left, take t from its u, repeat.
///
///   t -> u(t), the rate of the convex problem (solvers/convex.h)  ->  t_i = theta_i |u_it(t)|
///
/// A fixed point solves the Coulomb problem. anderson = depth > 0 accelerates the sequence of t
/// (not of r, which need not be unique), restarted when its residual grows. The convex problem is
/// solved to `inner` times the last change of t only, since t is not yet right.
/// One iteration is one iteration of the inner method. For theta = 0 the first t is the answer.
/// No convergence proof for friction: the map need not contract where mu is large. After 100
/// iterations without progress, or none left, up to 200 steps of a search for a proof that there is
/// no solution (solvers/certificate.h) go beside them.
/// Own test (StopTest::kOwn)  eta from the inner method's r and u.
/// Source  Acary, Cadoux, Lemarechal, Malick, ZAMM 91(2) (2011) 155-175 (not checked); Anderson on
///         t: ours.
Method aclm();  ///< inner: semismooth Newton on the augmented Lagrangian (solvers/ssnal.h)

struct AclmSettings {
  int anderson = 10;   ///< depth, 0 = plain
  double inner = 0.1;  ///< inner tolerance, as a share of the outer residual
};

std::unique_ptr<Iteration> make_aclm(const problems::Problem& problem,
                                     std::unique_ptr<ConvexIteration> inner,
                                     const AclmSettings& settings);

/// A method `name` whose inner problems are solved by what `make_inner` gives; `parameters` are the
/// inner method's own.
Method make_aclm_method(std::string name, std::string summary, std::vector<Parameter> parameters,
                        std::function<MakeConvex(const Values&)> make_inner,
                        std::function<Refuses(const Values&)> refuses);

}  // namespace conebench::solvers
