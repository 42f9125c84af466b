#include "problems/sparse.h"

#include <vector>

namespace conebench::problems {
namespace {

bool is_canonical(const SparseMatrix& matrix) {
  if (!matrix.isCompressed()) return false;
  for (int row = 0; row < matrix.outerSize(); ++row) {
    Eigen::Index last = -1;
    for (SparseMatrix::InnerIterator it(matrix, row); it; ++it) {
      if (it.value() == 0.0 || it.col() <= last) return false;
      last = it.col();
    }
  }
  return true;
}

}  // namespace

SparseMatrix canonical(const SparseMatrix& matrix) {
  if (is_canonical(matrix)) return matrix;
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (int row = 0; row < matrix.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator it(matrix, row); it; ++it) {
      if (it.value() != 0.0) entries.emplace_back(row, static_cast<int>(it.col()), it.value());
    }
  }
  SparseMatrix result(matrix.rows(), matrix.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  result.prune([](auto, auto, double value) { return value != 0.0; });
  result.makeCompressed();
  return result;
}

double asymmetry(const SparseMatrix& matrix) {
  if (matrix.nonZeros() == 0) return 0.0;
  const double size = matrix.norm();
  if (!(size > 0.0)) return 0.0;
  const SparseMatrix transposed = matrix.transpose();
  return SparseMatrix(matrix - transposed).norm() / size;
}

}  // namespace conebench::problems
