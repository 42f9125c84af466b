#pragma once

// Internal to problems/: what our own files and FCLIB's have in common.

#include <functional>
#include <string>
#include <vector>

#include "problems/hdf5_file.h"

namespace conebench::problems {

/// Runs `make` and lets what the problem's constructor refuses name the file instead.
Problem make_problem(const std::string& subject, const std::function<Problem()>& make);

/// Root attribute `rate_scale`, or nothing when the file has none.
std::optional<double> read_rate_scale(const hdf5::Reader& reader);

/// Writes root attribute `rate_scale` exactly when the data of `problem` alone would give another
/// number: when its kappa was shifted away, or when it is part of a larger problem. Costs the
/// construction of a problem.
void write_rate_scale(hdf5::Writer& writer, const Problem& problem);

/// /solution/{r,u,v} with attributes shifted = 1 and eta; u and v are computed where they lack.
void write_solution(hdf5::Writer& writer, const Problem& problem, const Solution& solution);

/// /solution, or nothing when there is none or r is all zeros (FCLIB's way of saying unsolved).
/// An r that was stored unshifted (attribute shifted = 0) is shifted.
std::optional<Solution> read_solution(const hdf5::Reader& reader, const Problem& problem);

/// Positions, indices and values of a matrix with compressed rows.
std::span<const int> begins(const SparseMatrix& matrix);
std::span<const int> inner_indices(const SparseMatrix& matrix);
std::span<const double> values(const SparseMatrix& matrix);

}  // namespace conebench::problems
