#pragma once

#include "solvers/iteration.h"
#include "solvers/local/one_cone.h"

namespace conebench::solvers {

struct GaussSeidelSettings {
  enum class Form { kAuto, kVelocity, kDelassus };

  LocalKind local = LocalKind::kExact;
  Form form = Form::kAuto;
  double omega = 1.0;               ///< relaxation of each cone's update [-]
  double regularization = 1e-9;     ///< share of lambda_i added to a singular W_ii [-]
  bool symmetric = false;           ///< every sweep is a forward and a backward pass
  std::int64_t partial_sweeps = 0;  ///< between two full ones
  bool islands = false;             ///< partial sweeps leave out islands instead of cones
  /// By colours (solvers/colouring.h), with so many threads; 0: those of the run. Then every sweep
  /// is full, and forward.
  std::optional<int> threads{};
};

/// Nonlinear Gauss-Seidel: one cone after another, each solved with all others held.
///
/// A sweep does, for each cone i in order, with u_i the rate at the current r,
///
///   q_i = u_i - B_i r_i,   r_i <- (1 - omega) r_i + omega local(B_i, q_i),
///
/// projected on K if omega != 1, where B_i = sym(W_ii), plus regularization lambda_i I where its
/// smallest eigenvalue is below regularization lambda_i: with the same B_i in q_i, fixed points
/// stay exact solutions.
///
/// Local   exact: the one-cone problem solved to rounding (solvers/local/exact.h). projection: one
///         projected step, r_i <- P_K(r_i - u_hat_i / lambda_i). newton-ac, newton-fb: semismooth
///         Newton from the current r_i; where it fails its best iterate is taken, and counted in
///         the notes. quartic: enumeration, cones of d = 1 and d = 3 with theta = mu only.
///         Where r_i = 0, theta = mu and u_n >= 0 exact asks no more than u_n of a cone: it stays
///         open.
/// Forms   velocity: mass-scaled velocities are updated in place; a cone costs its few bodies or
///         nodes. Needs a block-diagonal M. delassus: rows of W times r. auto takes the first that
///         is possible.
/// Sweeps  symmetric: forward, then backward, as one iteration of twice the cost. skip: up to that
///         many partial sweeps between two full ones, each an iteration, leave out the cones whose
///         latest change lambda_i |dr_i| was at most 1e-3 of the largest. islands: partial sweeps
///         (9, or `skip`) leave out the connected components whose latest change was at most 0.1
///         of the largest; since components do not feel each other, nothing is lost meanwhile
///         (solvers/gs_schedule.h). Only a full sweep can find that nothing moves any more.
/// Own estimate of eta  a tenth of max_i lambda_i |dr_i| / U over the latest change of each cone.
/// Memory  d = 3, two rigid bodies: 288 bytes of blocks, 112 between spheres, and about 270 of
/// local data a cone. No convergence proof for Coulomb friction; the residual judges. Source
/// Jourdan, Alart, Jean, CMAME 155 (1998) 31-47 (not checked); local step: our derivation.
Method gauss_seidel();

/// Why these settings cannot take the problem, or nothing.
std::optional<std::string> gauss_seidel_refuses(const problems::Problem& problem,
                                                const GaussSeidelSettings& settings);

/// Sweeps for other methods to drive. `problem` must outlive the iteration and not be refused.
std::unique_ptr<Iteration> make_gauss_seidel(const problems::Problem& problem,
                                             const GaussSeidelSettings& settings = {});

/// Iteration::work_s of one sweep over all cones.
double gauss_seidel_sweep_work_s(const problems::Problem& problem);

/// Bytes that one sweep of the velocity form with local=exact must read or write, each once: blocks
/// and indices, local data, r, w and y. Precondition: M is block diagonal.
std::size_t gauss_seidel_sweep_bytes(const problems::Problem& problem);

}  // namespace conebench::solvers
