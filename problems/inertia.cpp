#include "problems/inertia.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "problems/error.h"
#include "problems/union_find.h"

namespace conebench::problems {
namespace {

using Triplet = Eigen::Triplet<double, int>;
using ColumnMajor = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

std::vector<int> components(const SparseMatrix& M, int& count) {
  UnionFind sets(static_cast<int>(M.rows()));
  for (int row = 0; row < M.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator it(M, row); it; ++it) {
      if (it.value() != 0.0) sets.join(row, static_cast<int>(it.col()));
    }
  }
  return sets.labels(count);
}

// Appends L^-T of one component, where L L^T is its block of M.
void append_inverse_root(const SparseMatrix& M, std::span<const int> dofs, std::vector<int>& local,
                         std::string_view subject, std::vector<Triplet>& out) {
  const auto n = static_cast<Eigen::Index>(dofs.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    local[static_cast<std::size_t>(dofs[static_cast<std::size_t>(k)])] = static_cast<int>(k);
  }
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (SparseMatrix::InnerIterator it(M, dofs[static_cast<std::size_t>(k)]); it; ++it) {
      if (it.value() != 0.0) block(k, local[static_cast<std::size_t>(it.col())]) += it.value();
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(block);
  require(cholesky.info() == Eigen::Success, subject, "M is not positive definite on the ", n,
          " dofs connected to dof ", dofs.front(), ", expected M symmetric positive definite");
  const Eigen::MatrixXd root =
      cholesky.matrixU().solve(Eigen::MatrixXd::Identity(n, n)).triangularView<Eigen::Upper>();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {
      if (root(i, j) == 0.0) continue;
      out.emplace_back(dofs[static_cast<std::size_t>(i)], dofs[static_cast<std::size_t>(j)],
                       root(i, j));
    }
  }
}

}  // namespace

struct Inertia::Factor {
  Eigen::SimplicialLDLT<ColumnMajor> cholesky;
};

Inertia::Inertia() = default;
Inertia::~Inertia() = default;
Inertia::Inertia(Inertia&&) noexcept = default;

Inertia::Inertia(const SparseMatrix& M, std::string_view subject) {
  component_of_ = components(M, component_count_);
  const Groups members(component_of_, component_count_);

  std::vector<Triplet> root;
  std::vector<int> local(component_of_.size(), -1);
  for (int component = 0; component < component_count_; ++component) {
    const std::span<const int> dofs = members[component];
    if (dofs.size() == 1) {
      const double diagonal = M.coeff(dofs[0], dofs[0]);
      require(diagonal > 0.0, subject, "M(", dofs[0], ", ", dofs[0], ") is ", diagonal,
              ", so M is not positive definite, expected > 0");
      root.emplace_back(dofs[0], dofs[0], 1.0 / std::sqrt(diagonal));
      continue;
    }
    if (dofs.size() <= kLargestBlock) {
      append_inverse_root(M, dofs, local, subject, root);
      continue;
    }
    for (const int dof : dofs) {
      const double diagonal = M.coeff(dof, dof);
      require(diagonal > 0.0, subject, "M(", dof, ", ", dof, ") is ", diagonal,
              ", expected > 0: M symmetric positive definite");
      root.emplace_back(dof, dof, 1.0 / std::sqrt(diagonal));
      large_dofs_.push_back(dof);
    }
  }
  root_.resize(M.rows(), M.cols());
  root_.setFromTriplets(root.begin(), root.end());
  if (large_dofs_.empty()) return;

  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < large_dofs_.size(); ++k) {
    local[static_cast<std::size_t>(large_dofs_[k])] = static_cast<int>(k);
  }
  for (const int dof : large_dofs_) {
    for (SparseMatrix::InnerIterator it(M, dof); it; ++it) {
      if (it.value() == 0.0) continue;
      entries.emplace_back(local[static_cast<std::size_t>(dof)],
                           local[static_cast<std::size_t>(it.col())], it.value());
    }
  }
  const auto size = static_cast<Eigen::Index>(large_dofs_.size());
  ColumnMajor large(size, size);
  large.setFromTriplets(entries.begin(), entries.end());
  factor_ = std::make_unique<Factor>();
  factor_->cholesky.compute(large);
  require(
      factor_->cholesky.info() == Eigen::Success && factor_->cholesky.vectorD().minCoeff() > 0.0,
      subject, "M is not positive definite, expected M symmetric positive definite");
}

Inertia Inertia::of_part(const SparseMatrix& M_part, std::span<const int> dofs,
                         std::span<const int> position, std::string_view subject) const {
  if (!block_diagonal()) return Inertia(M_part, subject);
  Inertia part;
  part.root_ = extract(root_, dofs, position, static_cast<int>(dofs.size()));
  // Labels grow with each component's first dof, so their ranks are the part's labels.
  for (const int dof : dofs) {
    part.component_of_.push_back(component_of_[static_cast<std::size_t>(dof)]);
  }
  std::vector<int> kept = part.component_of_;
  std::ranges::sort(kept);
  kept.erase(std::ranges::unique(kept).begin(), kept.end());
  part.component_count_ = static_cast<int>(kept.size());
  for (int& label : part.component_of_) {
    label = static_cast<int>(std::ranges::lower_bound(kept, label) - kept.begin());
  }
  return part;
}

Eigen::VectorXd Inertia::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = root_ * (root_.transpose() * b);
  if (!factor_) return x;
  const Eigen::VectorXd large = factor_->cholesky.solve(Eigen::VectorXd(b(large_dofs_)));
  x(large_dofs_) = large;
  return x;
}

}  // namespace conebench::problems
