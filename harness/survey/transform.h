#pragma once

#include <cstdint>

#include "problems/made_backwards.h"

namespace conebench::harness {

/// A problem that says in other words what an original says. Answers to it are taken back by
///
///   r' = r_back r'_twin,   u = u_back u_twin.
struct Twin {
  problems::Problem problem;
  problems::SparseMatrix r_back, u_back;  ///< original rows x twin rows
};

// All of these take primal problems, kappa included; the standard problem of a twin is the twin of
// the standard problem. Cost: a few products of sparse matrices.

/// The same in other units: numbers of r, f, kappa grow by `force`, those of u, v, w by `rate`.
Twin in_units(const problems::Problem& original, double force, double rate);

/// Every cone's tangents turned (d = 2: reflected) by a random orthogonal matrix.
Twin with_turned_tangents(const problems::Problem& original, std::uint64_t seed);

/// The cones in a random order.
Twin in_random_order(const problems::Problem& original, std::uint64_t seed);

/// Every cone twice, each with half the strength: r' of the original is the sum over both copies.
/// r' is not unique, u is what it was; eta may differ by a small factor, since |W_ii| kappa_i does.
Twin with_cones_twice(const problems::Problem& original);

/// Cone `cone` of a made problem by itself: the other reactions become forces.
problems::Problem alone(const problems::MadeProblem& made, int cone);

/// The same data with another strength for every cone.
problems::Problem with_strength(const problems::Problem& problem, double kappa);

/// Cone `cone` without rows in H: W_ii = 0, and it moves at `rate` (dim entries) whatever r is.
problems::Problem with_prescribed_rate(const problems::Problem& problem, int cone,
                                       const Eigen::VectorXd& rate);

}  // namespace conebench::harness
