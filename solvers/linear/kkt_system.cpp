#include "solvers/linear/kkt_system.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <set>
#include <vector>

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;
using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

constexpr double kSecondsPerFlop = 1e-9, kSecondsPerNonzero = 25e-9;

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
    walk(BlockDiagonal(problem),
         [&](int row, int column, double) { entries.emplace_back(row, column, 0.0); });
    for (int row = 0; row < problem.rows(); ++row) {
      entries.emplace_back(dofs + row, dofs + row, -1.0);
    }
    matrix.resize(dofs + problem.rows(), dofs + problem.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    mass = matrix;
    factor.analyzePattern(matrix);
  }

  // Every entry of R H, below M.
  template <class Function>
  void walk(const BlockDiagonal& R, const Function& function) const {
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
      for (int b = 0; b < dim; ++b) {
        for (SparseMatrix::InnerIterator it(problem.H(), at + b); it; ++it) {
          for (int a = 0; a < dim; ++a) {
            function(problem.dofs() + at + a, static_cast<int>(it.col()), R[i](a, b) * it.value());
          }
        }
      }
    }
  }

  bool factorize(const BlockDiagonal& R) {
    matrix.coeffs() = mass.coeffs();
    walk(R, [&](int row, int column, double value) { matrix.coeffRef(row, column) += value; });
    factor.factorize(matrix);
    return factor.info() == Eigen::Success;
  }

  const Problem& problem;
  Matrix matrix, mass;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor;
};

KktSystem::KktSystem(const Problem& problem) : parts_(std::make_unique<Parts>(problem)) {}
KktSystem::~KktSystem() = default;

bool KktSystem::factorize(const BlockDiagonal& R) { return parts_->factorize(R); }

// M v = H^T R^T y and R H v + y = z: the unknowns are (v, -y).
Eigen::VectorXd KktSystem::solve(const Eigen::VectorXd& z) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(parts_->matrix.rows());
  whole.tail(z.size()) = z;
  return -Eigen::VectorXd(parts_->factor.solve(whole)).tail(z.size());
}

double KktSystem::work_s() const {
  const double nonzeros =
      static_cast<double>(parts_->factor.matrixL().nestedExpression().nonZeros());
  const double flops = nonzeros * nonzeros / static_cast<double>(parts_->matrix.rows());
  return kSecondsPerFlop * flops + kSecondsPerNonzero * nonzeros;
}

std::int64_t KktSystem::nonzeros(const Problem& problem) {
  std::int64_t coupling = 0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
    std::set<Eigen::Index> touched;
    for (int row = at; row < at + dim; ++row) {
      for (SparseMatrix::InnerIterator it(problem.H(), row); it; ++it) touched.insert(it.col());
    }
    coupling += dim * static_cast<std::int64_t>(touched.size());
  }
  return problem.M().nonZeros() / 2 + coupling + problem.rows();
}

}  // namespace conebench::solvers
