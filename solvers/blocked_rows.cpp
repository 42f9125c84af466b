#include "solvers/blocked_rows.h"

#include <algorithm>

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Starts of the groups of `length` columns that rows [first, first + dim) touch, increasing.
void collect_runs(const SparseMatrix& S, int first, int dim, int length, std::vector<int>& out) {
  out.clear();
  for (int row = first; row < first + dim; ++row) {
    for (SparseMatrix::InnerIterator it(S, row); it; ++it) {
      const int start = static_cast<int>(it.col()) / length * length;
      if (out.empty() || out.back() != start) out.push_back(start);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

std::size_t bytes_with(const Problem& problem, const SparseMatrix& S, int length) {
  std::size_t bytes = 0;
  std::vector<int> runs;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    collect_runs(S, problem.start(i), dim, length, runs);
    bytes += runs.size() * (8 * static_cast<std::size_t>(dim * length) + 4);
  }
  return bytes;
}

int best_run_length(const Problem& problem, const SparseMatrix& S) {
  int best = 1;
  std::size_t least = bytes_with(problem, S, 1);
  for (const int length : {2, 3, 6}) {
    const std::size_t bytes = bytes_with(problem, S, length);
    if (bytes <= least) {
      least = bytes;
      best = length;
    }
  }
  return best;
}

}  // namespace

BlockedRows::BlockedRows(const Problem& problem) {
  const SparseMatrix S = problem.H() * problem.inertia().inverse_root();
  run_length_ = best_run_length(problem, S);
  scaled_dofs_ = (problem.dofs() + run_length_ - 1) / run_length_ * run_length_;
  std::vector<int> runs;
  run_begin_.push_back(0);
  value_begin_.push_back(0);
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    collect_runs(S, problem.start(i), dim, run_length_, runs);
    run_start_.insert(run_start_.end(), runs.begin(), runs.end());
    const std::size_t base = values_.size();
    values_.resize(base + runs.size() * static_cast<std::size_t>(dim * run_length_), 0.0);
    for (int row = 0; row < dim; ++row) {
      for (SparseMatrix::InnerIterator it(S, problem.start(i) + row); it; ++it) {
        const int column = static_cast<int>(it.col());
        const int start = column / run_length_ * run_length_;
        const auto run = std::lower_bound(runs.begin(), runs.end(), start) - runs.begin();
        const auto at = (static_cast<int>(run) * dim + row) * run_length_ + column - start;
        values_[base + static_cast<std::size_t>(at)] = it.value();
      }
    }
    run_begin_.push_back(run_start_.size());
    value_begin_.push_back(values_.size());
  }
}

Eigen::MatrixXd BlockedRows::diagonal_block(int i, int dim) const {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(dim, dim);
  const double* block = blocks(i);
  for (std::size_t k = 0; k < runs(i).size(); ++k, block += dim * run_length_) {
    const Eigen::Map<const RowMajorMatrix> B(block, dim, run_length_);
    W.noalias() += B * B.transpose();
  }
  return W;
}

Eigen::VectorXd BlockedRows::scaled_velocity(const Problem& problem,
                                             const Eigen::VectorXd& r) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(scaled_dofs_);
  y.head(problem.dofs()) =
      problem.inertia().inverse_root().transpose() * (problem.f() + problem.H().transpose() * r);
  return y;
}

std::size_t BlockedRows::bytes() const {
  return values_.size() * sizeof(double) + run_start_.size() * sizeof(int) +
         (run_begin_.size() + value_begin_.size()) * sizeof(std::size_t);
}

BlockedDelassus::BlockedDelassus(const Problem& problem) {
  const SparseMatrix W = problem.delassus();
  std::vector<int> cone_of_row(static_cast<std::size_t>(problem.rows()));
  for (int i = 0; i < problem.cone_count(); ++i) {
    std::fill_n(cone_of_row.begin() + problem.start(i),
                problem.cones()[static_cast<std::size_t>(i)].dim, i);
  }
  std::vector<int> neighbours;
  entry_begin_.push_back(0);
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    neighbours.clear();
    for (int row = problem.start(i); row < problem.start(i) + dim; ++row) {
      for (SparseMatrix::InnerIterator it(W, row); it; ++it) {
        neighbours.push_back(cone_of_row[static_cast<std::size_t>(it.col())]);
      }
    }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    value_begin_.push_back(values_.size());
    std::vector<std::size_t> base(neighbours.size());
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const int other = problem.cones()[static_cast<std::size_t>(neighbours[k])].dim;
      base[k] = values_.size();
      values_.resize(values_.size() + static_cast<std::size_t>(dim * other), 0.0);
      entries_.push_back({problem.start(neighbours[k]), other});
    }
    for (int row = 0; row < dim; ++row) {
      for (SparseMatrix::InnerIterator it(W, problem.start(i) + row); it; ++it) {
        const int cone = cone_of_row[static_cast<std::size_t>(it.col())];
        const auto k = static_cast<std::size_t>(
            std::lower_bound(neighbours.begin(), neighbours.end(), cone) - neighbours.begin());
        const int other = problem.cones()[static_cast<std::size_t>(cone)].dim;
        const int at = row * other + static_cast<int>(it.col()) - problem.start(cone);
        values_[base[k] + static_cast<std::size_t>(at)] = it.value();
      }
    }
    entry_begin_.push_back(entries_.size());
  }
}

Eigen::MatrixXd BlockedDelassus::diagonal_block(const Problem& problem, int i) const {
  const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
  const double* block = blocks(i);
  for (const Entry& entry : entries(i)) {
    if (entry.row == problem.start(i)) return Eigen::Map<const RowMajorMatrix>(block, dim, dim);
    block += dim * entry.dim;
  }
  return Eigen::MatrixXd::Zero(dim, dim);
}

}  // namespace conebench::solvers
