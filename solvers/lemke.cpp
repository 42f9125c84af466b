#include "solvers/lemke.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace conebench::solvers {
namespace {

using Index = Eigen::Index;

constexpr double kLeastPivot = 1e-11;
constexpr double kTie = 1e-12;

}  // namespace

Lemke::Lemke(const Eigen::MatrixXd& M, const Eigen::VectorXd& q)
    : table_(M.rows(), M.rows() + 2),
      basic_(static_cast<std::size_t>(M.rows())),
      nonbasic_(static_cast<std::size_t>(M.rows()) + 1),
      column_of_(static_cast<std::size_t>(2 * M.rows() + 1), -1) {
  const Index n = M.rows();
  table_.leftCols(n) = M;
  table_.col(n).setOnes();
  table_.col(n + 1) = q;
  std::iota(basic_.begin(), basic_.end(), Index{0});
  std::iota(nonbasic_.begin(), nonbasic_.end(), n);
  for (Index k = 0; k <= n; ++k) column_of_[static_cast<std::size_t>(n + k)] = k;
}

LemkeEnd Lemke::solve(const std::function<bool(std::int64_t)>& go_on) {
  const Index n = size();
  if (n == 0 || table_.col(n + 1).minCoeff() >= 0.0) return LemkeEnd::kSolved;
  Index row = first_row(), column = n;
  while (go_on(pivots_)) {
    const Index leaves = basic_[static_cast<std::size_t>(row)];
    exchange(row, column);
    if (leaves == 2 * n) return LemkeEnd::kSolved;
    // The complement of what left enters.
    column = column_of_[static_cast<std::size_t>(leaves < n ? leaves + n : leaves - n)];
    row = leaving_row(column);
    if (row < 0) return LemkeEnd::kRay;
  }
  return LemkeEnd::kStopped;
}

Eigen::VectorXd Lemke::z() const {
  const Index n = size();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    const Index variable = basic_[static_cast<std::size_t>(i)];
    if (variable >= n && variable < 2 * n) z(variable - n) = std::max(0.0, table_(i, n + 1));
  }
  return z;
}

// The row of the least q; of equal ones the last, whose perturbation is the least.
Index Lemke::first_row() const {
  Index row = 0;
  for (Index i = 1; i < size(); ++i) {
    if (table_(i, size() + 1) <= table_(row, size() + 1)) row = i;
  }
  return row;
}

// The coefficient of e^power, power = 1..N, in the basic variable of `row`.
double Lemke::perturbation(Index row, Index power) const {
  const Index column = column_of_[static_cast<std::size_t>(power - 1)];
  if (column >= 0) return -table_(row, column);
  return basic_[static_cast<std::size_t>(row)] == power - 1 ? 1.0 : 0.0;
}

// Which basic variable first falls to 0 as that of `column` grows; -1: none does. z_0 goes first.
Index Lemke::leaving_row(Index column) const {
  const Index n = size();
  std::vector<Index> tied;
  // Keeps the rows of least value / -table_(row, column).
  const auto keep_least = [&](const std::vector<Index>& rows, const auto& value) {
    double least = std::numeric_limits<double>::infinity();
    for (const Index i : rows) least = std::min(least, value(i) / -table_(i, column));
    std::vector<Index> kept;
    for (const Index i : rows) {
      const double ratio = value(i) / -table_(i, column);
      if (ratio <= least + kTie * std::max(1.0, std::abs(least))) kept.push_back(i);
    }
    return kept;
  };
  for (Index i = 0; i < n; ++i) {
    if (table_(i, column) < -kLeastPivot) tied.push_back(i);
  }
  if (tied.empty()) return -1;
  tied = keep_least(tied, [&](Index i) { return std::max(0.0, table_(i, n + 1)); });
  for (const Index i : tied) {
    if (basic_[static_cast<std::size_t>(i)] == 2 * n) return i;
  }
  for (Index power = 1; power <= n && tied.size() > 1; ++power) {
    tied = keep_least(tied, [&](Index i) { return perturbation(i, power); });
  }
  return tied.front();
}

// The basic variable of `row` becomes nonbasic and the nonbasic one of `column` basic.
void Lemke::exchange(Index row, Index column) {
  const double pivot = table_(row, column);
  table_(row, column) = -1.0;
  table_.row(row) /= -pivot;
  const Eigen::VectorXd factors = table_.col(column);
  const Eigen::RowVectorXd pivot_row = table_.row(row);
  for (Index i = 0; i < size(); ++i) {
    if (i == row || factors(i) == 0.0) continue;
    table_(i, column) = 0.0;
    table_.row(i) += factors(i) * pivot_row;
  }
  auto& out = basic_[static_cast<std::size_t>(row)];
  auto& in = nonbasic_[static_cast<std::size_t>(column)];
  std::swap(out, in);
  column_of_[static_cast<std::size_t>(in)] = column;
  column_of_[static_cast<std::size_t>(out)] = -1;
  ++pivots_;
}

}  // namespace conebench::solvers
