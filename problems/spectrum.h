#pragma once

#include <optional>
#include <string>

#include "problems/problem.h"

namespace conebench::problems {

/// Rank and condition of W.
struct Spectrum {
  int rank = 0;            ///< of W, and of H
  int null_space = 0;      ///< rows - rank: independent reactions that move nothing (hyperstatic)
  double condition = 1.0;  ///< largest over smallest eigenvalue on the range of W: an estimate
};

/// Either the spectrum, or why it was not computed.
struct SpectrumAnswer {
  std::optional<Spectrum> spectrum;
  std::string reason{};
};

/// Rows above which the spectrum is not computed: the fill of the QR factor grows faster than the
/// problem.
constexpr int kLargestSpectrumRows = 40'000;

/// Rank: how many eigenvalues of W (its singular values, in the reduced form) are above 1e-12 of
/// the largest. By sparse QR factorisations of S = H F, F F^T = M^-1, so that W = S S^T (of W
/// itself in the reduced form), until the triangular factor is square; inverse iterations then find
/// the small singular values that its pivots do not show. Where the eigenvalues leave no gap at
/// 1e-12 the rank is uncertain by those next to it. Condition: (s_max / s_min)^2 of S on its range
/// (s_max / s_min of W), by Lanczos steps with the factor and its inverse: what they miss makes it
/// too small, by a percent. Where M couples more than Inertia::kLargestBlock dofs, diag(M) stands
/// for it there: the rank is right up to what is negligible, the condition is that of H diag(M)^-1
/// H^T.
///
/// Cost  two or more sparse QR factorisations (SuiteSparseQR where SuiteSparse's GPL parts are
///       built in, else Eigen's, far slower), and solves with the factor.
SpectrumAnswer spectrum(const Problem& problem);

}  // namespace conebench::problems
