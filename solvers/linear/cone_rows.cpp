#include "solvers/linear/cone_rows.h"

#include <algorithm>

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using Matrix = ConeRows::Matrix;

}  // namespace

ConeRows::ConeRows(const Problem& problem) {
  begin_.push_back(0);
  value_begin_.push_back(0);
  for (const auto& cone : problem.cones()) dims_.push_back(cone.dim);
  const SparseMatrix& H = problem.H();
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    const auto first = static_cast<std::ptrdiff_t>(dofs_.size());
    for (int row = problem.start(i); row < problem.start(i) + dim; ++row) {
      for (SparseMatrix::InnerIterator it(H, row); it; ++it) {
        dofs_.push_back(static_cast<int>(it.col()));
      }
    }
    std::sort(dofs_.begin() + first, dofs_.end());
    dofs_.erase(std::unique(dofs_.begin() + first, dofs_.end()), dofs_.end());
    const auto count = static_cast<Eigen::Index>(dofs_.size()) - first;
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(dim, count);
    for (int row = 0; row < dim; ++row) {
      for (SparseMatrix::InnerIterator it(H, problem.start(i) + row); it; ++it) {
        const auto at = std::lower_bound(dofs_.begin() + first, dofs_.end(), it.col());
        block(row, at - dofs_.begin() - first) = it.value();
      }
    }
    values_.insert(values_.end(), block.data(), block.data() + block.size());
    begin_.push_back(dofs_.size());
    value_begin_.push_back(values_.size());
    left_.resize(std::max(left_.size(), static_cast<std::size_t>(block.size())));
  }
  right_.resize(left_.size());
}

Matrix ConeRows::lower_mass(const Problem& problem) const {
  const int dofs_in_all = problem.dofs();
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(dofs_in_all));
  std::vector<std::size_t> limits(columns.size(), 512);  // length at which a column is settled
  auto settle = [](std::vector<int>& column) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
  };
  for (int i = 0; i < problem.cone_count(); ++i) {
    const auto touched = dofs(i);
    for (std::size_t k = 0; k < touched.size(); ++k) {
      auto& column = columns[static_cast<std::size_t>(touched[k])];
      column.insert(column.end(), touched.begin() + static_cast<std::ptrdiff_t>(k), touched.end());
      std::size_t& limit = limits[static_cast<std::size_t>(touched[k])];
      if (column.size() <= limit) continue;
      settle(column);
      limit = std::max(limit, 2 * column.size());
    }
  }
  for (int row = 0; row < dofs_in_all; ++row) {
    for (SparseMatrix::InnerIterator it(problem.M(), row); it; ++it) {
      if (it.col() <= row) columns[static_cast<std::size_t>(it.col())].push_back(row);
    }
  }
  Matrix lower(dofs_in_all, dofs_in_all);
  std::size_t nonzeros = 0;
  for (auto& column : columns) {
    settle(column);
    nonzeros += column.size();
  }
  lower.reserve(static_cast<Eigen::Index>(nonzeros));
  for (int j = 0; j < dofs_in_all; ++j) {
    lower.startVec(j);
    for (const int row : columns[static_cast<std::size_t>(j)]) lower.insertBack(row, j) = 0.0;
  }
  lower.finalize();
  for (int row = 0; row < dofs_in_all; ++row) {
    for (SparseMatrix::InnerIterator it(problem.M(), row); it; ++it) {
      if (it.col() <= row) lower.coeffRef(row, it.col()) = it.value();
    }
  }
  return lower;
}

Matrix ConeRows::mass(const Problem& problem) const {
  const Matrix lower = lower_mass(problem);
  Matrix whole = lower.selfadjointView<Eigen::Lower>();
  return whole;
}

void ConeRows::add_products(const BlockDiagonal& A, const BlockDiagonal& B, bool lower,
                            Matrix& matrix) {
  for (int i = 0; i < A.count(); ++i) {
    if (B[i].isZero(0.0)) continue;
    with_dimension(B[i].rows(),
                   [&]<int D>() { add_product<D>(i, A[i].data(), B[i].data(), lower, matrix); });
  }
}

template <int D>
void ConeRows::add_product(int i, const double* a, const double* b, bool lower, Matrix& matrix) {
  using Rows = Eigen::Matrix<double, D, Eigen::Dynamic>;
  using Block = Eigen::Map<const Eigen::Matrix<double, D, D>>;
  const auto k = static_cast<std::size_t>(i);
  const auto touched = dofs(i);
  const auto count = static_cast<Eigen::Index>(touched.size());
  const Eigen::Map<const Rows> H(values_.data() + value_begin_[k], dims_[k], count);
  Eigen::Map<Rows> left(left_.data(), dims_[k], count), right(right_.data(), dims_[k], count);
  left = Block(a, dims_[k], dims_[k]).lazyProduct(H);
  right = Block(b, dims_[k], dims_[k]).lazyProduct(H);
  for (Eigen::Index j = 0; j < count; ++j) {
    int at = matrix.outerIndexPtr()[touched[static_cast<std::size_t>(j)]];
    for (Eigen::Index row = lower ? j : 0; row < count; ++row) {
      while (matrix.innerIndexPtr()[at] < touched[static_cast<std::size_t>(row)]) ++at;
      matrix.valuePtr()[at] += left.col(row).dot(right.col(j));
    }
  }
}

}  // namespace conebench::solvers
