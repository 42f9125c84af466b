#include "solvers/blocked_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kLengths[] = {1, 2, 3, 6};
// What a run costs a sweep besides its bytes, as bytes read in the same time; measured.
constexpr std::size_t kBytesPerRun = 16;
constexpr double kRounding = 4e-15;  // of blocks of spheres, relative to s or g

// Where the runs of `length` columns that hold these columns start; both increase.
void collect_runs(std::span<const int> columns, int length, std::vector<int>& out) {
  out.clear();
  for (const int column : columns) {
    const int start = column / length * length;
    if (out.empty() || out.back() != start) out.push_back(start);
  }
}

// The sizes of all blocks, were the runs of this length.
struct Sizes {
  int length = 1;
  std::size_t runs = 0, doubles = 0;

  std::size_t cost() const { return 8 * doubles + (4 + kBytesPerRun) * runs; }
};

// The length that costs least; the longest where several cost as much.
Sizes best_sizes(const Problem& problem, problems::ScaledRows& rows) {
  std::vector<Sizes> sizes;
  for (const int length : kLengths) sizes.push_back({.length = length});
  std::vector<int> runs;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    rows.load(problem.start(i), dim);
    for (Sizes& size : sizes) {
      collect_runs(rows.columns(), size.length, runs);
      size.runs += runs.size();
      size.doubles += runs.size() * static_cast<std::size_t>(dim * size.length);
    }
  }
  return *std::ranges::min_element(std::views::reverse(sizes), {}, &Sizes::cost);
}

using SphereBlock = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
using Frame = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

SphereBlock sphere_block(const Frame& R, double s, double g) {
  SphereBlock block;
  block.leftCols<3>() = s * R;
  block.rightCols<3>() << Eigen::RowVector3d::Zero(), g * R.row(2), -g * R.row(1);
  return block;
}

// s and g of a block of spheres; nothing if it is none.
std::optional<Eigen::Vector2d> sphere_scales(const SphereBlock& block, const Frame& R) {
  const double square = R.squaredNorm();
  const double s = block.leftCols<3>().cwiseProduct(R).sum() / square;
  const double g = (block.row(1).tail<3>().dot(R.row(2)) - block.row(2).tail<3>().dot(R.row(1))) /
                   (square - R.row(0).squaredNorm());
  const SphereBlock error = block - sphere_block(R, s, g);
  const bool fits = error.leftCols<3>().cwiseAbs().maxCoeff() <= kRounding * std::abs(s) &&
                    error.rightCols<3>().cwiseAbs().maxCoeff() <= kRounding * std::abs(g);
  if (!fits) return std::nullopt;
  return Eigen::Vector2d(s, g);
}

}  // namespace

BlockedRows::BlockedRows(const Problem& problem) {
  problems::ScaledRows rows(problem.H(), problem.inertia().inverse_root());
  const Sizes sizes = best_sizes(problem, rows);
  run_length_ = sizes.length;
  scaled_dofs_ = (problem.dofs() + run_length_ - 1) / run_length_ * run_length_;
  run_start_.reserve(sizes.runs);
  values_.reserve(sizes.doubles);
  run_begin_.push_back(0);
  value_begin_.push_back(0);
  std::vector<int> runs;
  for (int i = 0; i < problem.cone_count(); ++i) {
    rows.load(problem.start(i), problem.cones()[static_cast<std::size_t>(i)].dim);
    collect_runs(rows.columns(), run_length_, runs);
    run_start_.insert(run_start_.end(), runs.begin(), runs.end());
    append_blocks(rows, runs);
    run_begin_.push_back(run_start_.size());
    value_begin_.push_back(values_.size());
  }
  compress_spheres(problem);
}

void BlockedRows::append_blocks(const problems::ScaledRows& rows, std::span<const int> runs) {
  const auto S = rows.S();
  const auto size = static_cast<Eigen::Index>(runs.size()) * S.rows() * run_length_;
  const std::size_t base = values_.size();
  values_.resize(base + static_cast<std::size_t>(size), 0.0);
  double* block = values_.data() + base;
  std::size_t run = 0;
  for (std::size_t k = 0; k < rows.columns().size(); ++k) {
    const int column = rows.columns()[k];
    while (column >= runs[run] + run_length_) {
      ++run;
      block += S.rows() * run_length_;
    }
    for (Eigen::Index row = 0; row < S.rows(); ++row) {
      block[row * run_length_ + column - runs[run]] = S(row, static_cast<Eigen::Index>(k));
    }
  }
}

// R is the first run's translational part over its size.
void BlockedRows::compress_spheres(const Problem& problem) {
  if (run_length_ != 6) return;
  std::vector<double> compact;
  std::vector<std::size_t> begin{0};
  for (int i = 0; i < problem.cone_count(); ++i) {
    const std::size_t count = runs(i).size();
    if (problem.cones()[static_cast<std::size_t>(i)].dim != 3 || count > 2) return;
    const auto block = [&](std::size_t k) {
      return Eigen::Map<const SphereBlock>(blocks(i) + 18 * k);
    };
    Frame R = Frame::Zero();
    if (count > 0) R = block(0).leftCols<3>() / block(0).row(0).head<3>().norm();
    compact.insert(compact.end(), R.data(), R.data() + R.size());
    for (std::size_t k = 0; k < count; ++k) {
      const auto scales = sphere_scales(block(k), R);
      if (!scales) return;
      compact.insert(compact.end(), {(*scales)(0), (*scales)(1)});
    }
    begin.push_back(compact.size());
  }
  of_spheres_ = true;
  values_ = std::move(compact);
  value_begin_ = std::move(begin);
}

Eigen::MatrixXd BlockedRows::diagonal_block(int i, int dim) const {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(dim, dim);
  const double* block = blocks(i);
  if (of_spheres_) {
    const Eigen::Map<const Frame> R(block);
    for (std::size_t k = 0; k < runs(i).size(); ++k) {
      const SphereBlock B = sphere_block(R, block[9 + 2 * k], block[10 + 2 * k]);
      W.noalias() += B * B.transpose();
    }
    return W;
  }
  for (std::size_t k = 0; k < runs(i).size(); ++k, block += dim * run_length_) {
    const Eigen::Map<const RowMajorMatrix> B(block, dim, run_length_);
    W.noalias() += B * B.transpose();
  }
  return W;
}

Eigen::VectorXd BlockedRows::free_velocity(const Problem& problem) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(scaled_dofs_);
  y.head(problem.dofs()) = problem.inertia().inverse_root().transpose() * problem.f();
  return y;
}

std::size_t BlockedRows::bytes() const {
  return values_.size() * sizeof(double) + run_start_.size() * sizeof(int) +
         (run_begin_.size() + value_begin_.size()) * sizeof(std::size_t);
}

BlockedDelassus::BlockedDelassus(const Problem& problem) {
  const SparseMatrix assembled = problem.is_primal() ? problem.delassus() : SparseMatrix();
  const SparseMatrix& W = problem.is_primal() ? assembled : problem.W();
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
