#include "problems/sparse.h"

#include <algorithm>
#include <utility>
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

SparseMatrix canonical(SparseMatrix matrix) {
  if (is_canonical(matrix)) return matrix;
  matrix.makeCompressed();
  int* const columns = matrix.innerIndexPtr();
  double* const values = matrix.valuePtr();
  int* const begin = matrix.outerIndexPtr();
  std::vector<std::pair<int, double>> row_entries;
  int next = 0;
  for (int row = 0; row < matrix.outerSize(); ++row) {
    row_entries.clear();
    for (int k = begin[row]; k < begin[row + 1]; ++k) {
      if (values[k] != 0.0) row_entries.emplace_back(columns[k], values[k]);
    }
    std::ranges::stable_sort(row_entries, {}, &std::pair<int, double>::first);
    begin[row] = next;
    for (std::size_t k = 0; k < row_entries.size();) {
      const int column = row_entries[k].first;
      double sum = 0.0;
      for (; k < row_entries.size() && row_entries[k].first == column; ++k) {
        sum += row_entries[k].second;
      }
      if (sum == 0.0) continue;
      columns[next] = column;
      values[next++] = sum;
    }
  }
  begin[matrix.outerSize()] = next;
  matrix.resizeNonZeros(next);
  return matrix;
}

SparseMatrix extract(const SparseMatrix& A, std::span<const int> rows,
                     std::span<const int> column_of, int columns) {
  Eigen::Index capacity = 0;
  for (const int row : rows) capacity += A.outerIndexPtr()[row + 1] - A.outerIndexPtr()[row];
  SparseMatrix out(static_cast<Eigen::Index>(rows.size()), columns);
  out.resizeNonZeros(capacity);
  int next = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (SparseMatrix::InnerIterator it(A, rows[k]); it; ++it) {
      const int column = column_of[static_cast<std::size_t>(it.col())];
      if (column < 0) continue;
      out.innerIndexPtr()[next] = column;
      out.valuePtr()[next++] = it.value();
    }
    out.outerIndexPtr()[k + 1] = next;
  }
  out.resizeNonZeros(next);
  return out;
}

double asymmetry(const SparseMatrix& matrix) {
  if (matrix.nonZeros() == 0) return 0.0;
  const double size = matrix.norm();
  if (!(size > 0.0)) return 0.0;
  const SparseMatrix transposed = matrix.transpose();
  return SparseMatrix(matrix - transposed).norm() / size;
}

}  // namespace conebench::problems
