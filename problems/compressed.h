#pragma once

#include <span>
#include <string>

#include "problems/sparse.h"

namespace conebench::problems {

/// A compressed matrix as a file gives it: not yet trusted, possibly with unsorted or repeated
/// inner indices and with arrays longer than what `begin` uses.
struct CompressedArrays {
  Eigen::Index rows = 0, cols = 0;
  std::span<const int> begin;     ///< outer + 1 positions
  std::span<const int> inner;     ///< inner index of each entry
  std::span<const double> value;  ///< of each entry
};

/// Checks that positions rise from 0, that indices lie inside the matrix and that nothing dangles.
/// Throws InputError with `subject` and a detail that starts with `what`. One pass.
SparseMatrix from_compressed_rows(const CompressedArrays& arrays, const std::string& subject,
                                  const std::string& what);
SparseMatrix from_compressed_columns(const CompressedArrays& arrays, const std::string& subject,
                                     const std::string& what);

/// Entries (row[k], column[k], value[k]); repeated ones are summed.
SparseMatrix from_triplets(Eigen::Index rows, Eigen::Index cols, std::span<const int> row,
                           std::span<const int> column, std::span<const double> value,
                           const std::string& subject, const std::string& what);

}  // namespace conebench::problems
