#include "problems/compressed.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "problems/error.h"

namespace conebench::problems {
namespace {

using Triplet = Eigen::Triplet<double, int>;

void check_shape(Eigen::Index rows, Eigen::Index cols, const std::string& subject,
                 const std::string& what) {
  constexpr Eigen::Index kLargest = std::numeric_limits<int>::max() - 1;
  require(rows >= 0 && cols >= 0 && rows <= kLargest && cols <= kLargest, subject, what,
          " has the shape ", rows, " x ", cols, ", expected 0 to ", kLargest);
}

void check_arrays(const CompressedArrays& arrays, Eigen::Index outer, Eigen::Index inner,
                  const std::string& subject, const std::string& what) {
  const auto begin = arrays.begin;
  require(static_cast<Eigen::Index>(begin.size()) == outer + 1, subject, what, " has ",
          begin.size(), " positions, expected ", outer + 1);
  require(begin.front() == 0, subject, what, "'s first position is ", begin.front(),
          ", expected 0");
  for (std::size_t k = 1; k < begin.size(); ++k) {
    require(begin[k] >= begin[k - 1], subject, what, "'s position ", k, " is ", begin[k], " after ",
            begin[k - 1], ", expected rising positions");
  }
  const auto entries = static_cast<std::size_t>(begin.back());
  require(arrays.inner.size() >= entries && arrays.value.size() >= entries, subject, what, " has ",
          arrays.inner.size(), " indices and ", arrays.value.size(), " values, expected ", entries);
  for (std::size_t k = 0; k < entries; ++k) {
    require(arrays.inner[k] >= 0 && arrays.inner[k] < inner, subject, what, "'s index ", k, " is ",
            arrays.inner[k], ", expected 0 to ", inner - 1);
  }
}

template <class Emit>
void for_each_entry(const CompressedArrays& arrays, Emit emit) {
  for (std::size_t outer = 0; outer + 1 < arrays.begin.size(); ++outer) {
    for (int k = arrays.begin[outer]; k < arrays.begin[outer + 1]; ++k) {
      const auto at = static_cast<std::size_t>(k);
      emit(static_cast<int>(outer), arrays.inner[at], arrays.value[at]);
    }
  }
}

SparseMatrix assemble(Eigen::Index rows, Eigen::Index cols, const std::vector<Triplet>& entries) {
  SparseMatrix matrix(rows, cols);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

SparseMatrix from_compressed_rows(const CompressedArrays& arrays, const std::string& subject,
                                  const std::string& what) {
  check_shape(arrays.rows, arrays.cols, subject, what);
  check_arrays(arrays, arrays.rows, arrays.cols, subject, what);
  std::vector<Triplet> entries;
  entries.reserve(static_cast<std::size_t>(arrays.begin.back()));
  for_each_entry(arrays, [&](int row, int col, double x) { entries.emplace_back(row, col, x); });
  return assemble(arrays.rows, arrays.cols, entries);
}

SparseMatrix from_compressed_columns(const CompressedArrays& arrays, const std::string& subject,
                                     const std::string& what) {
  check_shape(arrays.rows, arrays.cols, subject, what);
  check_arrays(arrays, arrays.cols, arrays.rows, subject, what);
  std::vector<Triplet> entries;
  entries.reserve(static_cast<std::size_t>(arrays.begin.back()));
  for_each_entry(arrays, [&](int col, int row, double x) { entries.emplace_back(row, col, x); });
  return assemble(arrays.rows, arrays.cols, entries);
}

SparseMatrix from_triplets(Eigen::Index rows, Eigen::Index cols, std::span<const int> row,
                           std::span<const int> column, std::span<const double> value,
                           const std::string& subject, const std::string& what) {
  check_shape(rows, cols, subject, what);
  std::vector<Triplet> entries;
  entries.reserve(value.size());
  for (std::size_t k = 0; k < value.size(); ++k) {
    require(row[k] >= 0 && row[k] < rows && column[k] >= 0 && column[k] < cols, subject, what,
            "'s entry ", k, " is at (", row[k], ", ", column[k], "), expected inside ", rows, " x ",
            cols);
    entries.emplace_back(row[k], column[k], value[k]);
  }
  return assemble(rows, cols, entries);
}

}  // namespace conebench::problems
