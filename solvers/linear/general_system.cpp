#include "solvers/linear/general_system.h"

#include <algorithm>

#include "solvers/blocked_rows.h"
#include "solvers/linear/lu.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using Matrix = Lu::Matrix;
using Triplets = std::vector<Eigen::Triplet<double>>;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Values of a matrix whose entries arrive in one fixed order: the order is learnt once, as
// positions among the stored values, and replayed ever after.
class Scatter {
 public:
  // `entries` in the order of later replays.
  void learn(int size, const Triplets& entries) {
    matrix.resize(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    position_.reserve(entries.size());
    for (const auto& entry : entries) {
      const int* begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[entry.col()];
      const int* end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[entry.col() + 1];
      position_.push_back(
          static_cast<int>(std::lower_bound(begin, end, entry.row()) - matrix.innerIndexPtr()));
    }
  }
  void restart() {
    matrix.coeffs().setZero();
    next_ = 0;
  }
  void add(double value) { matrix.valuePtr()[position_[next_++]] += value; }

  Matrix matrix;

 private:
  std::vector<int> position_;
  std::size_t next_ = 0;
};

}  // namespace

struct GeneralSystem::Reduced {
  explicit Reduced(const Problem& given) : problem(given), W(given) {
    Triplets entries;
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
      auto dense = [&](int column, int columns) {
        for (int b = 0; b < columns; ++b) {
          for (int a = 0; a < dim; ++a) entries.emplace_back(at + a, column + b, 0.0);
        }
      };
      dense(at, dim);
      for (const auto& entry : W.entries(i)) dense(entry.row, entry.dim);
    }
    scatter.learn(problem.rows(), entries);
    lu.analyse(scatter.matrix);
  }

  bool factorize(const BlockDiagonal& A, const BlockDiagonal& B, const BlockDiagonal* R) {
    scatter.restart();
    std::vector<int> cone_at(static_cast<std::size_t>(problem.rows()), 0);
    for (int i = 0; i < problem.cone_count(); ++i) {
      cone_at[static_cast<std::size_t>(problem.start(i))] = i;
    }
    Eigen::MatrixXd product;
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
      for (Eigen::Index k = 0; k < A[i].size(); ++k) scatter.add(A[i].data()[k]);
      const double* block = W.blocks(i);
      for (const auto& entry : W.entries(i)) {
        product.noalias() = B[i] * Eigen::Map<const RowMajorMatrix>(block, dim, entry.dim);
        if (R) product *= (*R)[cone_at[static_cast<std::size_t>(entry.row)]].transpose();
        for (Eigen::Index k = 0; k < product.size(); ++k) scatter.add(product.data()[k]);
        block += dim * entry.dim;
      }
    }
    return lu.factorize(scatter.matrix);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return lu.solve(b); }

  const Problem& problem;
  BlockedDelassus W;
  Scatter scatter;
  Lu lu;
};

struct GeneralSystem::Full {
  Full(const Problem& given, bool right_scaled) : problem(given) {
    Triplets entries;
    const BlockDiagonal none(problem);
    walk(none, none, right_scaled ? &none : nullptr,
         [&](int row, int column, double) { entries.emplace_back(row, column, 0.0); });
    scatter.learn(problem.dofs() + problem.rows(), entries);
    lu.analyse(scatter.matrix);
  }

  // Every entry of [M, -H^T R^T; B H, A], always in the same order; R null is the identity.
  template <class Function>
  void walk(const BlockDiagonal& A, const BlockDiagonal& B, const BlockDiagonal* R,
            const Function& function) const {
    const int dofs = problem.dofs();
    for (int row = 0; row < dofs; ++row) {
      for (SparseMatrix::InnerIterator it(problem.M(), row); it; ++it) {
        function(row, static_cast<int>(it.col()), it.value());
      }
    }
    for (int row = 0; row < problem.rows() && !R; ++row) {
      for (SparseMatrix::InnerIterator it(problem.H(), row); it; ++it) {
        function(static_cast<int>(it.col()), dofs + row, -it.value());
      }
    }
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
      for (int a = 0; a < dim; ++a) {
        for (int b = 0; b < dim; ++b) {
          function(dofs + at + a, dofs + at + b, A[i](a, b));
          for (SparseMatrix::InnerIterator it(problem.H(), at + b); it; ++it) {
            const int column = static_cast<int>(it.col());
            function(dofs + at + a, column, B[i](a, b) * it.value());
            if (R) function(column, dofs + at + a, -(*R)[i](a, b) * it.value());
          }
        }
      }
    }
  }

  bool factorize(const BlockDiagonal& A, const BlockDiagonal& B, const BlockDiagonal* R) {
    scatter.restart();
    walk(A, B, R, [&](int, int, double value) { scatter.add(value); });
    return lu.factorize(scatter.matrix);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(problem.dofs() + problem.rows());
    whole.tail(problem.rows()) = b;
    return lu.solve(whole).tail(problem.rows());
  }

  const Problem& problem;
  Scatter scatter;
  Lu lu;
};

GeneralSystem::GeneralSystem(const Problem& problem, Form form, bool right_scaled) {
  bool full = form == Form::kFull;
  if (form == Form::kAuto && problem.is_primal()) {
    // A coupled M makes W dense, too dear even to count.
    full = !problem.inertia().block_diagonal() ||
           problem.delassus().nonZeros() >
               problem.M().nonZeros() + 2 * problem.H().nonZeros() + 3 * problem.rows();
  }
  if (full) {
    full_ = std::make_unique<Full>(problem, right_scaled);
  } else {
    reduced_ = std::make_unique<Reduced>(problem);
  }
}
GeneralSystem::~GeneralSystem() = default;

bool GeneralSystem::factorize(const BlockDiagonal& A, const BlockDiagonal& B,
                              const BlockDiagonal* R) {
  return full_ ? full_->factorize(A, B, R) : reduced_->factorize(A, B, R);
}

Eigen::VectorXd GeneralSystem::solve(const Eigen::VectorXd& b) const {
  return full_ ? full_->solve(b) : reduced_->solve(b);
}

double GeneralSystem::work_s() const { return full_ ? full_->lu.work_s() : reduced_->lu.work_s(); }

}  // namespace conebench::solvers
