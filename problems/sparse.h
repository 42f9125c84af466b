#pragma once

#include <Eigen/SparseCore>

namespace conebench::problems {

/// The only sparse type that crosses a folder: compressed rows, 12 bytes per nonzero.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// Rows sorted, duplicates summed, stored zeros dropped. Two matrices with the same numbers have
/// the same canonical form, whatever file they came from.
SparseMatrix canonical(const SparseMatrix& matrix);

/// |A - A^T|_F / |A|_F of a square matrix; 0 for an empty or zero one.
double asymmetry(const SparseMatrix& matrix);

}  // namespace conebench::problems
