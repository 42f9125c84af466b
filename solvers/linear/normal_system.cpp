#include "solvers/linear/normal_system.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "solvers/blocked_rows.h"
#include "solvers/linear/cholesky.h"
#include "solvers/linear/cone_rows.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using Matrix = Cholesky::Matrix;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

struct NormalSystem::Primal {
  explicit Primal(const Problem& given)
      : problem(given),
        rows(given),
        identity(given),
        E(given),
        mass(rows.lower_mass(given)),
        matrix(mass) {
    for (int i = 0; i < identity.count(); ++i) identity[i].setIdentity();
    cholesky.analyse(matrix);
  }

  bool factorize(const BlockDiagonal& scaling) {
    E = scaling;
    return factorize(identity, scaling);
  }
  bool factorize_root(const BlockDiagonal& root) {
    E = root;
    return factorize(root, root);
  }
  bool factorize(const BlockDiagonal& left, const BlockDiagonal& right) {
    matrix.coeffs() = mass.coeffs();
    rows.add_products(left, right, true, matrix);
    return cholesky.factorize(matrix);
  }

  Eigen::VectorXd solve_rate(const Eigen::VectorXd& b) const {
    return problem.H() * cholesky.solve(problem.H().transpose() * b);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return b - E * solve_rate(b); }

  Eigen::VectorXd solve_root_rate(const Eigen::VectorXd& z) const {
    return problem.H() * cholesky.solve(problem.H().transpose() * E.transpose_times(z));
  }

  Eigen::VectorXd solve_root(const Eigen::VectorXd& z) const { return z - E * solve_root_rate(z); }

  const Problem& problem;
  ConeRows rows;
  BlockDiagonal identity, E;  // or E's root R
  Matrix mass, matrix;
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
  return ConeRows(problem).lower_mass(problem).nonZeros();
}

}  // namespace conebench::solvers
