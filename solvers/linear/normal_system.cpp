#include "solvers/linear/normal_system.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "solvers/blocked_rows.h"
#include "solvers/linear/cholesky.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using Matrix = Cholesky::Matrix;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The rows of H cone by cone: which dofs a cone touches, and its dense block on them.
class ConeRows {
 public:
  explicit ConeRows(const Problem& problem) {
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
    }
  }

  std::span<const int> dofs(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {dofs_.data() + begin_[k], begin_[k + 1] - begin_[k]};
  }
  Eigen::Map<const Eigen::MatrixXd> block(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {values_.data() + value_begin_[k], dims_[k],
            static_cast<Eigen::Index>(begin_[k + 1] - begin_[k])};
  }

 private:
  std::vector<std::size_t> begin_, value_begin_;
  std::vector<int> dims_, dofs_;
  std::vector<double> values_;
};

// Lower triangle of the pattern of M + H^T E H with zeros stored, M's values added later.
Matrix pattern(const Problem& problem, const ConeRows& rows) {
  const int dofs = problem.dofs();
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(dofs));
  std::vector<std::size_t> limits(columns.size(), 512);  // length at which a column is settled
  auto settle = [](std::vector<int>& column) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
  };
  for (int i = 0; i < problem.cone_count(); ++i) {
    const auto touched = rows.dofs(i);
    for (std::size_t k = 0; k < touched.size(); ++k) {
      auto& column = columns[static_cast<std::size_t>(touched[k])];
      column.insert(column.end(), touched.begin() + static_cast<std::ptrdiff_t>(k), touched.end());
      std::size_t& limit = limits[static_cast<std::size_t>(touched[k])];
      if (column.size() <= limit) continue;
      settle(column);
      limit = std::max(limit, 2 * column.size());
    }
  }
  for (int row = 0; row < dofs; ++row) {
    for (SparseMatrix::InnerIterator it(problem.M(), row); it; ++it) {
      if (it.col() <= row) columns[static_cast<std::size_t>(it.col())].push_back(row);
    }
  }
  Matrix lower(dofs, dofs);
  std::size_t nonzeros = 0;
  for (auto& column : columns) {
    settle(column);
    nonzeros += column.size();
  }
  lower.reserve(static_cast<Eigen::Index>(nonzeros));
  for (int j = 0; j < dofs; ++j) {
    lower.startVec(j);
    for (const int row : columns[static_cast<std::size_t>(j)]) lower.insertBack(row, j) = 0.0;
  }
  lower.finalize();
  return lower;
}

// Adds the lower triangle of A^T B, whose rows and columns are `dofs`, all of which are stored.
template <int kDim>
void add_lower(std::span<const int> dofs, const double* a, const double* b, int dim,
               Matrix& lower) {
  using Rows = Eigen::Map<const Eigen::Matrix<double, kDim, Eigen::Dynamic>>;
  const auto count = static_cast<Eigen::Index>(dofs.size());
  const Rows A(a, dim, count), B(b, dim, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    int at = lower.outerIndexPtr()[dofs[static_cast<std::size_t>(j)]];
    for (Eigen::Index i = j; i < count; ++i) {
      while (lower.innerIndexPtr()[at] < dofs[static_cast<std::size_t>(i)]) ++at;
      lower.valuePtr()[at] += A.col(i).dot(B.col(j));
    }
  }
}

void add_lower(std::span<const int> dofs, const Eigen::Map<const Eigen::MatrixXd>& A,
               const Eigen::MatrixXd& B, Matrix& lower) {
  const int dim = static_cast<int>(A.rows());
  switch (dim) {
    case 1:
      return add_lower<1>(dofs, A.data(), B.data(), dim, lower);
    case 2:
      return add_lower<2>(dofs, A.data(), B.data(), dim, lower);
    case 3:
      return add_lower<3>(dofs, A.data(), B.data(), dim, lower);
    case 6:
      return add_lower<6>(dofs, A.data(), B.data(), dim, lower);
    default:
      return add_lower<Eigen::Dynamic>(dofs, A.data(), B.data(), dim, lower);
  }
}

}  // namespace

struct NormalSystem::Primal {
  explicit Primal(const Problem& given)
      : problem(given), rows(given), E(given), matrix(pattern(given, rows)), mass(matrix) {
    for (int row = 0; row < problem.dofs(); ++row) {
      for (SparseMatrix::InnerIterator it(problem.M(), row); it; ++it) {
        if (it.col() <= row) mass.coeffRef(row, it.col()) = it.value();
      }
    }
    cholesky.analyse(matrix);
  }

  bool factorize(const BlockDiagonal& scaling) {
    E = scaling;
    matrix.coeffs() = mass.coeffs();
    Eigen::MatrixXd EH;
    for (int i = 0; i < problem.cone_count(); ++i) {
      if (scaling[i].isZero(0.0)) continue;
      EH.noalias() = scaling[i].lazyProduct(rows.block(i));
      add_lower(rows.dofs(i), rows.block(i), EH, matrix);
    }
    return cholesky.factorize(matrix);
  }

  Eigen::VectorXd solve_rate(const Eigen::VectorXd& b) const {
    return problem.H() * cholesky.solve(problem.H().transpose() * b);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return b - E * solve_rate(b); }

  bool factorize_root(const BlockDiagonal& root) {
    E = root;
    matrix.coeffs() = mass.coeffs();
    Eigen::MatrixXd RH;
    for (int i = 0; i < problem.cone_count(); ++i) {
      RH.noalias() = root[i].lazyProduct(rows.block(i));
      add_lower(rows.dofs(i), {RH.data(), RH.rows(), RH.cols()}, RH, matrix);
    }
    return cholesky.factorize(matrix);
  }

  Eigen::VectorXd solve_root_rate(const Eigen::VectorXd& z) const {
    return problem.H() * cholesky.solve(problem.H().transpose() * E.transpose_times(z));
  }

  Eigen::VectorXd solve_root(const Eigen::VectorXd& z) const { return z - E * solve_root_rate(z); }

  const Problem& problem;
  ConeRows rows;
  BlockDiagonal E;  // or its root R
  Matrix matrix, mass;
  Cholesky cholesky;
};

struct NormalSystem::Reduced {
  explicit Reduced(const Problem& given) : problem(given), W(given), G(given) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
      for (int row = problem.start(i); row < problem.start(i) + dim; ++row) {
        entries.emplace_back(row, row, 0.0);
      }
      for_lower_blocks(i, [&](int column, const auto& block) {
        for (Eigen::Index b = 0; b < block.cols(); ++b) {
          for (Eigen::Index a = 0; a < block.rows(); ++a) {
            entries.emplace_back(problem.start(i) + static_cast<int>(a),
                                 column + static_cast<int>(b), 0.0);
          }
        }
      });
    }
    matrix.resize(problem.rows(), problem.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    cholesky.analyse(matrix);
  }

  // Blocks W_ij, j <= i: function(first column, block).
  template <class Function>
  void for_lower_blocks(int i, const Function& function) const {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    const double* block = W.blocks(i);
    for (const auto& entry : W.entries(i)) {
      if (entry.row > problem.start(i)) break;
      function(entry.row, Eigen::Map<const RowMajorMatrix>(block, dim, entry.dim));
      block += dim * entry.dim;
    }
  }

  bool factorize(const BlockDiagonal& E) {
    for (int i = 0; i < problem.cone_count(); ++i) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(E[i]);
      G[i] = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
             eigen.eigenvectors().transpose();
    }
    return factorize_root(G);
  }

  // I + R W R^T.
  bool factorize_root(const BlockDiagonal& R) {
    G = R;
    std::vector<int> cone_at(static_cast<std::size_t>(problem.rows()), 0);
    for (int i = 0; i < problem.cone_count(); ++i) {
      cone_at[static_cast<std::size_t>(problem.start(i))] = i;
    }
    matrix.coeffs().setZero();
    for (int row = 0; row < problem.rows(); ++row) matrix.coeffRef(row, row) = 1.0;
    for (int i = 0; i < problem.cone_count(); ++i) {
      for_lower_blocks(i, [&](int column, const auto& block) {
        const int j = cone_at[static_cast<std::size_t>(column)];
        Eigen::MatrixXd scaled = G[i] * block * G[j].transpose();
        if (i == j) scaled = (0.5 * (scaled + scaled.transpose())).eval();
        for (Eigen::Index b = 0; b < scaled.cols(); ++b) {
          for (Eigen::Index a = i == j ? b : 0; a < scaled.rows(); ++a) {
            matrix.coeffRef(problem.start(i) + a, column + b) += scaled(a, b);
          }
        }
      });
    }
    return cholesky.factorize(matrix);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    return b - G * cholesky.solve(G * problem.apply_delassus(b));
  }

  const Problem& problem;
  BlockedDelassus W;
  BlockDiagonal G;
  Matrix matrix;
  Cholesky cholesky;
};

NormalSystem::NormalSystem(const Problem& problem) {
  if (problem.is_primal()) {
    primal_ = std::make_unique<Primal>(problem);
  } else {
    reduced_ = std::make_unique<Reduced>(problem);
  }
}
NormalSystem::~NormalSystem() = default;

bool NormalSystem::factorize_root(const BlockDiagonal& R) {
  return primal_ ? primal_->factorize_root(R) : reduced_->factorize_root(R);
}

Eigen::VectorXd NormalSystem::solve_root(const Eigen::VectorXd& z) const {
  return primal_ ? primal_->solve_root(z) : reduced_->cholesky.solve(z);
}

Eigen::VectorXd NormalSystem::solve_root_rate(const Eigen::VectorXd& z) const {
  if (primal_) return primal_->solve_root_rate(z);
  return reduced_->problem.apply_delassus(reduced_->G.transpose_times(solve_root(z)));
}

bool NormalSystem::factorize(const BlockDiagonal& E) {
  return primal_ ? primal_->factorize(E) : reduced_->factorize(E);
}

Eigen::VectorXd NormalSystem::solve(const Eigen::VectorXd& b) const {
  return primal_ ? primal_->solve(b) : reduced_->solve(b);
}

Eigen::VectorXd NormalSystem::solve_rate(const Eigen::VectorXd& b) const {
  return primal_ ? primal_->solve_rate(b) : reduced_->problem.apply_delassus(reduced_->solve(b));
}

double NormalSystem::work_s() const {
  return primal_ ? primal_->cholesky.work_s() : reduced_->cholesky.work_s();
}

std::int64_t NormalSystem::nonzeros(const Problem& problem) {
  return pattern(problem, ConeRows(problem)).nonZeros();
}

}  // namespace conebench::solvers
