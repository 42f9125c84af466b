#pragma once

#include <Eigen/SparseCore>
#include <span>

namespace conebench::problems {

/// The only sparse type that crosses a folder: compressed rows, 12 bytes per nonzero.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// Rows sorted, duplicates summed, stored zeros dropped. Two matrices with the same numbers have
/// the same canonical form, whatever file they came from. In place: hand the matrix over.
SparseMatrix canonical(SparseMatrix matrix);

/// The rows given, in that order, of the columns j with column_of[j] >= 0, which become columns
/// column_of[j] of `columns`. Canonical when A is and column_of increases where it is >= 0.
SparseMatrix extract(const SparseMatrix& A, std::span<const int> rows,
                     std::span<const int> column_of, int columns);

/// |A - A^T|_F / |A|_F of a square matrix; 0 for an empty or zero one.
double asymmetry(const SparseMatrix& matrix);

}  // namespace conebench::problems
