#pragma once

#include <vector>

#include "solvers/method.h"

namespace conebench::solvers {

/// The solvers of Siconos Numerics 4.4 as peers: siconos:nsgs, siconos:nsgs-pli, siconos:nsn-ac,
/// siconos:nsn-fb, siconos:vi-eg, siconos:prox, siconos:aclmfp, siconos:admm, and the model
/// siconos:soclcp (associated law). Empty in a build without Siconos.
///
/// They get the reduced form (W, q), W as blocks of a cone by a cone; every cone of dimension 3
/// (siconos:nsgs also 2) and Coulomb's law (siconos:soclcp: any theta, treated as 0). Every solve
/// runs in a child process, since Siconos aborts on some problems: a crash is a result (kDiverged,
/// with a note), at the time limit the child is killed and r is as far as it got.
///
/// Stopping  Siconos stops on its own error, |r - P_K(r - u_hat)| in its own units over the largest
///           of |q|, |r|, |u|; at tolerance 1e-6 eta is 1e-6 to 0.5. With StopTest::kOwn that
///           test at stop.tol decides and the status is its claim. With kCommon eta decides: as
///           long as Siconos meets its own test and eta is not met, it is run on from where it
///           stopped with a tighter tolerance.
/// Clock     set-up: W and Siconos' structures; solve: its driver, timed in the child. Forking is
///           not counted, nor is building the structures again for a further run.
std::vector<Method> siconos_methods();

}  // namespace conebench::solvers
