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

/// Rank by a sparse rank-revealing QR factorisation of S = H F, F F^T = M^-1, so that W = S S^T (of
/// W itself in the reduced form): pivots below 1e-10 of the largest column count as 0. It is the
/// numerical rank, and a heuristic one: column pivoting within a sparse ordering can miss a null
/// space that no pivot shows, never the other way round.
/// Condition, (s_max / s_min)^2 of S on its range (s_max / s_min of W), by power and inverse
/// iterations with the triangular factor: what they miss makes it too small, by some percent.
/// Where M couples more than Inertia::kLargestBlock dofs, diag(M) stands for it there: the rank is
/// right, the condition is that of H diag(M)^-1 H^T.
/// Cost    two sparse QR factorisations (SuiteSparseQR where SuiteSparse's GPL parts are built in,
///         else Eigen's, far slower), only one where S or its transpose has full rank.
SpectrumAnswer spectrum(const Problem& problem);

}  // namespace conebench::problems
