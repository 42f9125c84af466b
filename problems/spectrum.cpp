#include "problems/spectrum.h"

#include <algorithm>
#include <cmath>
#include <random>

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

// Pivots below this share of the largest column are zero.
constexpr double kNegligible = 1e-10;
constexpr int kIterations = 60;
// A singular value that changes by less than this from one iteration to the next is good enough.
constexpr double kSettled = 1e-4;

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
  const double tolerance = kNegligible * largest_column(A);
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
  qr.setPivotThreshold(kNegligible * largest_column(A));
  qr.compute(A);
  const int rank = static_cast<int>(qr.rank());
  return {rank, ColumnMajor(qr.matrixR()).topRows(rank)};
}
#endif

// The triangular factor whose singular values are those of A that are not negligible.
Triangle compress(const ColumnMajor& A) {
  const ColumnMajor transposed = A.transpose();
  Triangle triangle = factorize(A.rows() >= A.cols() ? A : transposed);
  if (triangle.rank < triangle.R.cols()) triangle = factorize(ColumnMajor(triangle.R.transpose()));
  return triangle;
}

Eigen::VectorXd start_vector(int size) {
  std::mt19937 random(1);
  Eigen::VectorXd x(size);
  for (double& value : x) value = static_cast<double>(random()) * 0x1p-32 - 0.5;
  return x.normalized();
}

// The largest eigenvalue of a symmetric positive definite map.
template <class Map>
double largest_eigenvalue(int size, const Map& map) {
  Eigen::VectorXd x = start_vector(size);
  double value = 0.0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    x = map(x);
    const double next = x.norm();
    x /= next;
    const bool settled = std::abs(next - value) <= kSettled * next;
    value = next;
    if (settled) break;
  }
  return value;
}

// (s_max / s_min)^2 of a triangular matrix.
double squared_condition(const ColumnMajor& R) {
  const int size = static_cast<int>(R.cols());
  const auto upper = R.triangularView<Eigen::Upper>();
  const ColumnMajor transposed = R.transpose();
  const auto lower = transposed.triangularView<Eigen::Lower>();
  const double largest = largest_eigenvalue(
      size, [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(transposed * (R * x)); });
  const double inverse = largest_eigenvalue(size, [&](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(upper.solve(Eigen::VectorXd(lower.solve(x))));
  });
  return largest * inverse;
}

}  // namespace

SpectrumAnswer spectrum(const Problem& problem) {
  if (problem.rows() > kLargestSpectrumRows) {
    return {{}, "more than " + std::to_string(kLargestSpectrumRows) + " rows"};
  }
  const ColumnMajor S = problem.is_primal()
                            ? ColumnMajor(problem.H() * problem.inertia().inverse_root())
                            : ColumnMajor(problem.W());
  Spectrum answer{.null_space = problem.rows()};
  if (S.nonZeros() == 0) return {answer};
  const Triangle triangle = compress(S);
  if (triangle.rank == 0) return {{}, "the factorisation failed (memory)"};
  answer.rank = triangle.rank;
  answer.null_space = problem.rows() - triangle.rank;
  const double squared = squared_condition(triangle.R);
  answer.condition = problem.is_primal() ? squared : std::sqrt(squared);
  return {answer};
}

}  // namespace conebench::problems
