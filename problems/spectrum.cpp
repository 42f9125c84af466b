#include "problems/spectrum.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#ifdef CONEBENCH_SUITESPARSE
#include <Eigen/CholmodSupport>
#include <SuiteSparseQR.hpp>
#else
#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>
#endif

namespace conebench::problems {
namespace {

using ColumnMajor = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// Eigenvalues of W below this share of the largest count as 0: rounding of W, or of the geometry.
constexpr double kNegligible = 1e-12;
// Pivots below this share of the largest column are zero. Both for W and for S, whose negligible
// singular values are larger.
constexpr double kNegligiblePivot = 1e-12;
constexpr int kLanczosSteps = 60;
// A coupling below this share of the first diagonal entry ends the Lanczos steps: the space is
// invariant.
constexpr double kInvariant = 1e-14;
// Vectors of the first attempt at the smallest singular values, and inverse iterations with them.
constexpr int kFirstBlock = 8;
constexpr int kInverseIterations = 8;

// The first `rank` rows of R in a rank-revealing QR factorisation of A, columns permuted.
struct Triangle {
  int rank = 0;
  ColumnMajor R;
};

double largest_column(const ColumnMajor& A) {
  double largest = 0.0;
  for (int column = 0; column < A.cols(); ++column) {
    largest = std::max(largest, A.col(column).norm());
  }
  return largest;
}

#ifdef CONEBENCH_SUITESPARSE
Triangle factorize(ColumnMajor A) {
  using Index = SuiteSparse_long;
  const double tolerance = kNegligiblePivot * largest_column(A);
  Eigen::SparseMatrix<double, Eigen::ColMajor, Index> wide = A;
  cholmod_sparse view = Eigen::viewAsCholmod(wide);
  cholmod_common common;
  cholmod_l_start(&common);
  common.print = 0;
  cholmod_sparse* R = nullptr;
  Index* order = nullptr;
  const Index rank =
      SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, tolerance, 0, &view, &R, &order, &common);
  Triangle triangle;
  if (rank >= 0 && R != nullptr) {
    const auto stored = Eigen::viewAsEigen<double, Eigen::ColMajor, Index>(*R);
    triangle.rank = static_cast<int>(rank);
    triangle.R = ColumnMajor(stored).topRows(triangle.rank);
  }
  cholmod_l_free_sparse(&R, &common);
  cholmod_l_free(static_cast<std::size_t>(A.cols()), sizeof(Index), order, &common);
  cholmod_l_finish(&common);
  return triangle;
}
#else
Triangle factorize(ColumnMajor A) {
  A.makeCompressed();
  Eigen::SparseQR<ColumnMajor, Eigen::COLAMDOrdering<int> > qr;
  qr.setPivotThreshold(kNegligiblePivot * largest_column(A));
  qr.compute(A);
  const int rank = static_cast<int>(qr.rank());
  const SparseMatrix sorted = qr.matrixR();  // its columns are not
  return {rank, sorted.topRows(rank)};
}
#endif

// The triangular factor, square, whose singular values are those of A but for pivots of 0.
Triangle compress(const ColumnMajor& A) {
  const ColumnMajor transposed = A.transpose();
  Triangle triangle = factorize(A.rows() >= A.cols() ? A : transposed);
  while (triangle.rank < triangle.R.cols()) {
    triangle = factorize(ColumnMajor(triangle.R.transpose()));
  }
  return triangle;
}

Eigen::MatrixXd random_block(int rows, int columns) {
  std::mt19937 random(1);
  Eigen::MatrixXd block(rows, columns);
  for (double& value : block.reshaped()) value = static_cast<double>(random()) * 0x1p-32 - 0.5;
  return block;
}

// The largest eigenvalue of a symmetric positive definite map, from below, by Lanczos steps.
// Without reorthogonalisation eigenvalues come twice, which does not matter here.
template <class Map>
double largest_eigenvalue(int size, const Map& map) {
  const int most = std::min(size, kLanczosSteps);
  Eigen::VectorXd diagonal(most), coupling(most);
  Eigen::VectorXd x = random_block(size, 1).normalized(), before = Eigen::VectorXd::Zero(size);
  int steps = 0;
  while (steps < most) {
    Eigen::VectorXd y = map(x);
    if (steps > 0) y -= coupling(steps - 1) * before;
    diagonal(steps) = x.dot(y);
    y -= diagonal(steps) * x;
    const double norm = coupling(steps) = y.norm();
    ++steps;
    if (norm <= kInvariant * diagonal(0)) break;
    before = x;
    x = y / norm;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> tridiagonal;
  tridiagonal.computeFromTridiagonal(diagonal.head(steps), coupling.head(steps - 1),
                                     Eigen::EigenvaluesOnly);
  return tridiagonal.eigenvalues().maxCoeff();
}

// A square triangular factor and its inverse.
class Square {
 public:
  explicit Square(ColumnMajor R) : R_(std::move(R)), transposed_(R_.transpose()) {}

  int size() const { return static_cast<int>(R_.cols()); }

  double largest_singular_value() const {
    return std::sqrt(largest_eigenvalue(size(), [this](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(transposed_ * (R_ * x));
    }));
  }

  /// Of those that belong to vectors orthogonal to `null`.
  double smallest_singular_value(const Eigen::MatrixXd& null) const {
    auto rest = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(x - null * (null.transpose() * x));
    };
    return 1.0 / std::sqrt(largest_eigenvalue(size(), [&](const Eigen::VectorXd& x) {
             Eigen::MatrixXd y = rest(x);
             solve_lower(y);
             solve_upper(y);
             return rest(y);
           }));
  }

  /// Orthonormal basis of the vectors whose singular values lie below a bound.
  Eigen::MatrixXd below(double bound) const {
    for (int block = std::min(kFirstBlock, size());; block = std::min(2 * block, size())) {
      Eigen::MatrixXd X = below(bound, block);
      if (X.cols() < block || block == size()) return X;
    }
  }

 private:
  void solve_lower(Eigen::MatrixXd& X) const {
    transposed_.triangularView<Eigen::Lower>().solveInPlace(X);
  }
  void solve_upper(Eigen::MatrixXd& X) const { R_.triangularView<Eigen::Upper>().solveInPlace(X); }

  // As many as there are, or as the block holds: by inverse iterations.
  Eigen::MatrixXd below(double bound, int block) const {
    Eigen::MatrixXd X = orthonormal(random_block(size(), block));
    Eigen::MatrixXd Y;
    for (int iteration = 1;; ++iteration) {
      Y = X;
      solve_lower(Y);
      if (iteration == kInverseIterations) break;
      solve_upper(Y);
      X = orthonormal(Y);
    }
    std::vector<int> small;
    for (int k = 0; k < block; ++k) {
      if (bound * Y.col(k).norm() > 1.0) small.push_back(k);
    }
    return X(Eigen::all, small);
  }

  static Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& X) {
    return Eigen::HouseholderQR<Eigen::MatrixXd>(X).householderQ() *
           Eigen::MatrixXd::Identity(X.rows(), X.cols());
  }

  ColumnMajor R_, transposed_;
};

}  // namespace

SpectrumAnswer spectrum(const Problem& problem) {
  if (problem.rows() > kLargestSpectrumRows) {
    return {{}, "more than " + std::to_string(kLargestSpectrumRows) + " rows"};
  }
  const ColumnMajor S = problem.is_primal()
                            ? ColumnMajor(problem.H() * problem.inertia().inverse_root())
                            : ColumnMajor(problem.W());
  Spectrum answer{.null_space = problem.rows()};
  if (S.nonZeros() == 0 || largest_column(S) == 0.0) return {answer};
  const Square factor(compress(S).R);
  if (factor.size() == 0) return {{}, "the factorisation failed (memory)"};
  // W's eigenvalues are the squares of the singular values of S.
  const double power = problem.is_primal() ? 2.0 : 1.0;
  const double largest = factor.largest_singular_value();
  const Eigen::MatrixXd null = factor.below(largest * std::pow(kNegligible, 1.0 / power));
  answer.rank = factor.size() - static_cast<int>(null.cols());
  answer.null_space = problem.rows() - answer.rank;
  answer.condition = std::pow(largest / factor.smallest_singular_value(null), power);
  return {answer};
}

}  // namespace conebench::problems
