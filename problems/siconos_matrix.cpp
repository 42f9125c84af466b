#include "problems/siconos_matrix.h"

#include <cmath>
#include <limits>

namespace conebench::problems {
namespace {

// The numbers with which a file names its storages.
enum Storage { kDense = 0, kBlocks = 1, kSparse = 2 };
enum Origin { kTriplets = 1, kColumns = 2, kRows = 3 };

constexpr int kLargest = std::numeric_limits<int>::max() - 1;

using Triplet = Eigen::Triplet<double, int>;

SparseMatrix assemble(int rows, int cols, const std::vector<Triplet>& entries) {
  SparseMatrix matrix(rows, cols);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void check_room(TextReader& in, const std::string& name, std::int64_t rows, std::int64_t cols) {
  if (rows * cols > kLargest) in.fail(name + " has more than 2^31 entries");
}

SparseMatrix read_dense(TextReader& in, const std::string& name, int rows, int cols) {
  const int again[] = {in.integer(name + "'s rows", rows, rows),
                       in.integer(name + "'s columns", cols, cols)};
  check_room(in, name, again[0], again[1]);
  const Eigen::VectorXd values = in.numbers(name + "'s entries", rows * cols);
  const double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
  const double rounding = std::numeric_limits<double>::epsilon() * largest;
  std::vector<Triplet> entries;
  for (int k = 0; k < values.size(); ++k) {
    if (std::abs(values(k)) > rounding) entries.emplace_back(k % rows, k / rows, values(k));
  }
  return assemble(rows, cols, entries);
}

// The file gives the end of each block row (or column).
std::vector<int> read_block_starts(TextReader& in, const std::string& what, int count, int size) {
  std::vector<int> starts = in.integers(what, count, 1, size);
  starts.insert(starts.begin(), 0);
  for (std::size_t k = 1; k < starts.size(); ++k) {
    if (starts[k] <= starts[k - 1]) in.fail(what + " do not rise");
  }
  if (starts.back() != size) in.fail(what + " do not end at " + std::to_string(size));
  return starts;
}

SparseMatrix read_blocks(TextReader& in, const std::string& name, int rows, int cols) {
  const int blocks = in.integer(name + "'s number of blocks", 0, kLargest);
  if (blocks == 0) return {rows, cols};
  const int block_rows = in.integer(name + "'s block rows", 1, rows);
  const int block_cols = in.integer(name + "'s block columns", 1, cols);
  const std::vector<int> row = read_block_starts(in, name + "'s block rows", block_rows, rows);
  const std::vector<int> col = read_block_starts(in, name + "'s block columns", block_cols, cols);
  const int positions = in.integer(name + "'s positions", 1, block_rows + 1);
  in.integer(name + "'s filled blocks", blocks, blocks);
  const std::vector<int> begin = in.integers(name + "'s positions", positions, 0, blocks);
  const std::vector<int> inner = in.integers(name + "'s block columns", blocks, 0, block_cols - 1);
  if (begin.front() != 0 || begin.back() != blocks) in.fail(name + " has dangling blocks");
  std::vector<Triplet> entries;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    for (int block = begin[i]; block < begin[i + 1]; ++block) {
      const auto j = static_cast<std::size_t>(inner[static_cast<std::size_t>(block)]);
      const int height = row[i + 1] - row[i], width = col[j + 1] - col[j];
      check_room(in, name, height, width);
      in.integer(name + "'s block number", block, block);
      const Eigen::VectorXd values = in.numbers(name + "'s entries", height * width);
      for (int k = 0; k < values.size(); ++k) {
        entries.emplace_back(row[i] + k % height, col[j] + k / height, values(k));
      }
    }
    if (begin[i + 1] < begin[i]) in.fail(name + "'s positions do not rise");
  }
  return assemble(rows, cols, entries);
}

SparseMatrix read_triplets(TextReader& in, const std::string& name, int rows, int cols, int count) {
  std::vector<Triplet> entries;
  for (int k = 0; k < count; ++k) {
    const int row = in.integer(name + "'s row", 0, rows - 1);
    const int col = in.integer(name + "'s column", 0, cols - 1);
    in.expect(":");
    entries.emplace_back(row, col, in.number(name + "'s entries"));
  }
  return assemble(rows, cols, entries);
}

// Lines "col J : locations A to B", each followed by its entries "INDEX : VALUE".
SparseMatrix read_columns(TextReader& in, const std::string& name, int rows, int cols, int count) {
  std::vector<Triplet> entries;
  for (int col = 0; col < cols; ++col) {
    in.expect("col");
    in.integer(name + "'s column number", col, col);
    in.expect(":");
    in.expect("locations");
    const auto first = static_cast<int>(entries.size());
    in.integer(name + "'s first position", first, first);
    in.expect("to");
    const int last = in.integer(name + "'s last position", first - 1, count - 1);
    for (int k = first; k <= last; ++k) {
      const int row = in.integer(name + "'s row", 0, rows - 1);
      in.expect(":");
      entries.emplace_back(row, col, in.number(name + "'s entries"));
    }
  }
  return assemble(rows, cols, entries);
}

// "R-by-C," as CSparse prints it.
void expect_shape(TextReader& in, const std::string& name, std::string_view found, int rows,
                  int cols) {
  const std::string wanted = std::to_string(rows) + "-by-" + std::to_string(cols) + ",";
  if (found != wanted) in.fail(name + " is '" + std::string(found) + "', expected " + wanted);
}

SparseMatrix read_sparse(TextReader& in, const std::string& name, int rows, int cols) {
  const int origin = in.integer(name + "'s kind", kTriplets, kRows);
  in.expect("CSparse");
  in.skip_line();
  std::string_view shape = in.word(name + "'s shape");
  const bool triplets = shape == "triplet:";
  if (triplets) shape = in.word(name + "'s shape");
  if (triplets != (origin == kTriplets)) in.fail(name + " is not of the kind that it claims");
  if (origin == kRows && rows != cols) {
    in.fail(name + " is compressed by rows and not square, which Siconos does not write in full");
  }
  expect_shape(in, name, shape, rows, cols);
  in.expect("nzmax:");
  in.word(name + "'s capacity");
  in.expect("nnz:");
  const int count = in.leading_integer(name + "'s number of entries");
  in.skip_line();
  if (triplets) return read_triplets(in, name, rows, cols, count);
  const SparseMatrix matrix = read_columns(in, name, rows, cols, count);
  return origin == kRows ? SparseMatrix(matrix.transpose()) : matrix;
}

}  // namespace

SparseMatrix read_siconos_matrix(TextReader& in, const std::string& name) {
  const int storage = in.integer(name + "'s storage", kDense, kSparse);
  const int rows = in.integer(name + "'s rows", 0, kLargest);
  const int cols = in.integer(name + "'s columns", 0, kLargest);
  // Vectors of these lengths follow, so a longer claim than the file is false.
  in.require_room(name + "'s rows and columns", std::int64_t{rows} + cols);
  switch (storage) {
    case kDense:
      return read_dense(in, name, rows, cols);
    case kBlocks:
      return read_blocks(in, name, rows, cols);
    default:
      return read_sparse(in, name, rows, cols);
  }
}

}  // namespace conebench::problems
