#include "solvers/linear/kkt_system.h"

#include <Eigen/SparseCholesky>

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

}  // namespace

struct KktSystem::Parts {
  explicit Parts(const Problem& given) : problem(given) {
    const int dofs = problem.dofs();
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < dofs; ++row) {
      for (SparseMatrix::InnerIterator it(problem.M(), row); it; ++it) {
        if (it.col() <= row) entries.emplace_back(row, static_cast<int>(it.col()), it.value());
      }
    }
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
      for (int a = 0; a < dim; ++a) {
        for (SparseMatrix::InnerIterator it(problem.H(), at + a); it; ++it) {
          entries.emplace_back(dofs + at + a, static_cast<int>(it.col()), it.value());
        }
        for (int b = 0; b <= a; ++b) entries.emplace_back(dofs + at + a, dofs + at + b, 0.0);
      }
    }
    matrix.resize(dofs + problem.rows(), dofs + problem.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor.analyzePattern(matrix);
  }

  bool factorize(const BlockDiagonal& Z) {
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
      const int at = problem.dofs() + problem.start(i);
      for (int a = 0; a < dim; ++a) {
        for (int b = 0; b <= a; ++b) matrix.coeffRef(at + a, at + b) = -Z[i](a, b);
      }
    }
    factor.factorize(matrix);
    return factor.info() == Eigen::Success;
  }

  const Problem& problem;
  Matrix matrix;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor;
};

KktSystem::KktSystem(const Problem& problem) : parts_(std::make_unique<Parts>(problem)) {}
KktSystem::~KktSystem() = default;

bool KktSystem::factorize(const BlockDiagonal& Z) { return parts_->factorize(Z); }

// M y = H^T x and H y + Z x = b: the unknowns are (y, -x).
Eigen::VectorXd KktSystem::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(parts_->matrix.rows());
  whole.tail(b.size()) = b;
  return -parts_->factor.solve(whole).tail(b.size());
}

std::int64_t KktSystem::nonzeros(const Problem& problem) {
  std::int64_t blocks = 0;
  for (const problems::Cone& cone : problem.cones()) blocks += cone.dim * (cone.dim + 1) / 2;
  return problem.M().nonZeros() / 2 + problem.H().nonZeros() + blocks;
}

}  // namespace conebench::solvers
