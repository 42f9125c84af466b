#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "problems/problem.h"
#include "problems/scaled_rows.h"

namespace conebench::solvers {

/// The rows of H F cone by cone, as dense blocks over runs of consecutive dofs, where F F^T = M^-1
/// (problems::Inertia::inverse_root). In mass-scaled velocities y, v = F y:
///
///   u_i = B_i y + w_i,   y = F^T f + sum_i B_i^T r_i,   W_ii = B_i B_i^T,
///
/// so that one block, read once, serves both directions of a Gauss-Seidel update.
///
/// A run is `run_length` dofs starting at a multiple of run_length (6 for 3D rigid bodies, 2 or 3
/// for grid nodes); the length is the one of {6, 3, 2, 1} that is cheapest to sweep over: about the
/// one of fewest bytes.
///
/// Spheres. Between spheres the contact lies on the normal n from either centre, so that a run's
/// block is
///
///   [ s R   g T ],   R = (n, t1, t2)^T,   T = (0, t2, -t1)^T,
///
/// with s = +-1 / sqrt(m) and g = radius / sqrt(J), J the moment of inertia. Where this holds to
/// rounding for every cone (of d = 3, on at most two runs of 6), R and the pairs (s, g) are kept
/// instead: about a third of the bytes and of the arithmetic.
/// Memory  8 d run_length + 4 bytes per cone and run; of spheres, 72 per cone and 20 per cone and
/// run. Precondition: M is block diagonal.
class BlockedRows {
 public:
  explicit BlockedRows(const problems::Problem& problem);

  int run_length() const { return run_length_; }
  bool of_spheres() const { return of_spheres_; }
  /// Length of y: dofs, rounded up to whole runs.
  int scaled_dofs() const { return scaled_dofs_; }

  /// First dof of each run of cone i.
  std::span<const int> runs(int i) const {
    const auto first = run_begin_[static_cast<std::size_t>(i)];
    return {run_start_.data() + first, run_begin_[static_cast<std::size_t>(i) + 1] - first};
  }
  /// The cone's blocks, one after another in the order of runs(i): dim x run_length, row-major. Of
  /// spheres: R, row-major, then s and g of each run.
  const double* blocks(int i) const {
    return values_.data() + value_begin_[static_cast<std::size_t>(i)];
  }

  Eigen::MatrixXd diagonal_block(int i, int dim) const;

  /// y without reactions: F^T f.
  Eigen::VectorXd free_velocity(const problems::Problem& problem) const;

  /// Numbers in all blocks.
  double numbers() const { return static_cast<double>(values_.size()); }
  /// Bytes of the blocks and their indices.
  std::size_t bytes() const;

 private:
  void append_blocks(const problems::ScaledRows& rows, std::span<const int> runs);
  void compress_spheres(const problems::Problem& problem);

  int run_length_ = 1;
  bool of_spheres_ = false;
  int scaled_dofs_ = 0;
  std::vector<std::size_t> run_begin_, value_begin_;
  std::vector<int> run_start_;
  std::vector<double> values_;
};

/// Products with the blocks of a cone, in runs of L dofs. D, the cone's dimension, is that of the
/// vectors at compile time, or Eigen::Dynamic.
template <int L>
struct RunProducts {
  /// u += B_i y.
  template <class Vector>
  static void add_rate(const BlockedRows& rows, int i, const double* y, Vector& u) {
    constexpr int D = Vector::RowsAtCompileTime;
    using Block =
        Eigen::Matrix<double, D, L, (D == 1 || L > 1) ? Eigen::RowMajor : Eigen::ColMajor>;
    const double* block = rows.blocks(i);
    for (const int run : rows.runs(i)) {
      u.noalias() += Eigen::Map<const Block>(block, u.size(), L) *
                     Eigen::Map<const Eigen::Matrix<double, L, 1>>(y + run);
      block += u.size() * L;
    }
  }

  /// The first row of B_i times y; dim is the cone's dimension.
  static double normal_rate(const BlockedRows& rows, int i, int dim, const double* y) {
    const double* block = rows.blocks(i);
    double sum = 0.0;
    for (const int run : rows.runs(i)) {
      for (int k = 0; k < L; ++k) sum += block[k] * y[run + k];
      block += dim * L;
    }
    return sum;
  }

  /// y += B_i^T x.
  template <class Vector>
  static void add_reaction(const BlockedRows& rows, int i, const Vector& x, double* y) {
    const double* block = rows.blocks(i);
    for (const int run : rows.runs(i)) {
      add_transposed(block, x, y + run);
      block += x.size() * L;
    }
  }

 private:
  // The sum before y: the next cone often adds to the same y.
  template <class Vector>
  static void add_transposed(const double* block, const Vector& x, double* y) {
    constexpr int D = Vector::RowsAtCompileTime;
    if constexpr (L == 1) {
      *y += x.dot(Eigen::Map<const Eigen::Matrix<double, D, 1>>(block, x.size()));
    } else {
      using Run = Eigen::Matrix<double, L, 1>;
      Run sum = x(0) * Eigen::Map<const Run>(block);
      if constexpr (D == Eigen::Dynamic) {
        for (Eigen::Index row = 1; row < x.size(); ++row) {
          sum += x(row) * Eigen::Map<const Run>(block + row * L);
        }
      } else {
        [&]<int... above>(std::integer_sequence<int, above...>) {
          ((sum += x(above + 1) * Eigen::Map<const Run>(block + (above + 1) * L)), ...);
        }
        (std::make_integer_sequence<int, D - 1>());
      }
      Eigen::Map<Run>(y) += sum;
    }
  }
};

/// The same where rows.of_spheres(). Vectors have 3 entries; those that cannot have them do
/// nothing, so that whoever is generic in the dimension compiles.
struct SphereProducts {
  template <class Vector>
  static constexpr bool kMayHaveThree =
      Vector::RowsAtCompileTime == 3 || Vector::RowsAtCompileTime == Eigen::Dynamic;

  template <class Vector>
  static void add_rate(const BlockedRows& rows, int i, const double* y, Vector& u) {
    if constexpr (kMayHaveThree<Vector>) {
      const double *R = rows.blocks(i), *scales = R + 9;
      double v[3] = {}, omega[3] = {};
      for (const int run : rows.runs(i)) {
        for (int k = 0; k < 3; ++k) v[k] += scales[0] * y[run + k];
        for (int k = 0; k < 3; ++k) omega[k] += scales[1] * y[run + 3 + k];
        scales += 2;
      }
      auto along = [R](int row, const double* x) {
        return R[3 * row] * x[0] + R[3 * row + 1] * x[1] + R[3 * row + 2] * x[2];
      };
      u(0) += along(0, v);
      u(1) += along(1, v) + along(2, omega);
      u(2) += along(2, v) - along(1, omega);
    }
  }

  static double normal_rate(const BlockedRows& rows, int i, int /*dim*/, const double* y) {
    const double *n = rows.blocks(i), *scales = n + 9;
    double sum = 0.0;
    for (const int run : rows.runs(i)) {
      sum += scales[0] * (n[0] * y[run] + n[1] * y[run + 1] + n[2] * y[run + 2]);
      scales += 2;
    }
    return sum;
  }

  template <class Vector>
  static void add_reaction(const BlockedRows& rows, int i, const Vector& x, double* y) {
    if constexpr (kMayHaveThree<Vector>) {
      const double *R = rows.blocks(i), *scales = R + 9;
      double force[3], torque[3];
      for (int k = 0; k < 3; ++k) {
        force[k] = R[k] * x(0) + R[3 + k] * x(1) + R[6 + k] * x(2);
        torque[k] = R[6 + k] * x(1) - R[3 + k] * x(2);
      }
      for (const int run : rows.runs(i)) {
        for (int k = 0; k < 3; ++k) y[run + k] += scales[0] * force[k];
        for (int k = 0; k < 3; ++k) y[run + 3 + k] += scales[1] * torque[k];
        scales += 2;
      }
    }
  }
};

/// function.operator()<Products>() with those that suit the rows.
template <class Function>
decltype(auto) with_products(const BlockedRows& rows, const Function& function) {
  if (rows.of_spheres()) return function.template operator()<SphereProducts>();
  switch (rows.run_length()) {
    case 6:
      return function.template operator()<RunProducts<6>>();
    case 3:
      return function.template operator()<RunProducts<3>>();
    case 2:
      return function.template operator()<RunProducts<2>>();
    default:
      return function.template operator()<RunProducts<1>>();
  }
}

/// W cone by cone as dense blocks, columns increasing, for the Delassus form.
/// Memory  8 d_i d_j + 8 bytes per block.
class BlockedDelassus {
 public:
  /// Assembles W (problems::Problem::delassus) where the problem does not hold it already.
  explicit BlockedDelassus(const problems::Problem& problem);

  struct Entry {
    int row;  ///< first row of cone j in r
    int dim;  ///< of cone j
  };

  std::span<const Entry> entries(int i) const {
    const auto first = entry_begin_[static_cast<std::size_t>(i)];
    return {entries_.data() + first, entry_begin_[static_cast<std::size_t>(i) + 1] - first};
  }
  /// Blocks W_ij in the order of entries(i): d_i x d_j, row-major.
  const double* blocks(int i) const {
    return values_.data() + value_begin_[static_cast<std::size_t>(i)];
  }

  Eigen::MatrixXd diagonal_block(const problems::Problem& problem, int i) const;

  /// u += the rows of W of cone i times r.
  template <class Vector>
  void add_rate(int i, const Eigen::VectorXd& r, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    const double* block = blocks(i);
    for (const Entry& entry : entries(i)) {
      if (D != Eigen::Dynamic && entry.dim == D) {
        add_square_product(block, r.data() + entry.row, u);
      } else {
        u.noalias() +=
            Eigen::Map<
                const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                block, u.size(), entry.dim) *
            r.segment(entry.row, entry.dim);
      }
      block += u.size() * entry.dim;
    }
  }

  /// The first row of W of cone i times r; dim is the cone's dimension.
  double normal_rate(int i, int dim, const Eigen::VectorXd& r) const {
    const double* block = blocks(i);
    double sum = 0.0;
    for (const Entry& entry : entries(i)) {
      for (int k = 0; k < entry.dim; ++k) sum += block[k] * r(entry.row + k);
      block += dim * entry.dim;
    }
    return sum;
  }

  /// Numbers in all blocks.
  double numbers() const { return static_cast<double>(values_.size()); }

 private:
  template <class Vector>
  static void add_square_product(const double* block, const double* r, Vector& u) {
    constexpr int D = Vector::RowsAtCompileTime;
    for (int row = 0; row < D; ++row) {
      for (int column = 0; column < D; ++column) u(row) += block[row * D + column] * r[column];
    }
  }

  std::vector<std::size_t> entry_begin_, value_begin_;
  std::vector<Entry> entries_;
  std::vector<double> values_;
};

}  // namespace conebench::solvers
