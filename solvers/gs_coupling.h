#pragma once

#include "solvers/blocked_rows.h"

namespace conebench::solvers {

/// How a cone's rate feels the other cones, for one-cone-at-a-time methods. Both couplings have
///
///   refresh(r)        brings the state to reactions r, without the rounding gathered so far
///   diagonal_block(i) W_ii
///   rate(i, at, u)    u_i at the current state; `at` is the cone's first row
///   moved(i, change)  r_i has moved by `change`
///
/// with u and change of fixed or dynamic size.

/// From mass-scaled velocities, in runs of L dofs: what a cone costs is its few bodies or nodes.
template <int L>
class VelocityCoupling {
 public:
  VelocityCoupling(const problems::Problem& problem, BlockedRows rows)
      : problem_(problem), rows_(std::move(rows)) {}

  const BlockedRows& rows() const { return rows_; }

  void refresh(const Eigen::VectorXd& r) { y_ = rows_.scaled_velocity(problem_, r); }

  Eigen::MatrixXd diagonal_block(int i) const {
    return rows_.diagonal_block(i, problem_.cones()[static_cast<std::size_t>(i)].dim);
  }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    u = problem_.w().segment<D>(at, u.size());
    const double* block = rows_.blocks(i);
    for (const int run : rows_.runs(i)) {
      add_product<D, L>(block, y_.data() + run, u);
      block += u.size() * L;
    }
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    constexpr int D = Vector::RowsAtCompileTime;
    const double* block = rows_.blocks(i);
    for (const int run : rows_.runs(i)) {
      add_transposed_product<D, L>(block, change, y_.data() + run);
      block += change.size() * L;
    }
  }

 private:
  const problems::Problem& problem_;
  BlockedRows rows_;
  Eigen::VectorXd y_;
};

/// From rows of W.
class DelassusCoupling {
 public:
  explicit DelassusCoupling(const problems::Problem& problem) : problem_(problem), W_(problem) {}

  const BlockedDelassus& blocks() const { return W_; }

  void refresh(const Eigen::VectorXd& r) { r_ = r; }

  Eigen::MatrixXd diagonal_block(int i) const { return W_.diagonal_block(problem_, i); }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    u = problem_.q().segment<D>(at, u.size());
    const double* block = W_.blocks(i);
    for (const auto& entry : W_.entries(i)) {
      if (D != Eigen::Dynamic && entry.dim == D) {
        u.noalias() += Block<D>(block, D, D) * r_.segment<D>(entry.row, entry.dim);
      } else {
        u.noalias() +=
            Block<Eigen::Dynamic>(block, u.size(), entry.dim) * r_.segment(entry.row, entry.dim);
      }
      block += u.size() * entry.dim;
    }
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    r_.segment<Vector::RowsAtCompileTime>(problem_.start(i), change.size()) += change;
  }

 private:
  template <int D>
  using Block =
      Eigen::Map<const Eigen::Matrix<double, D, D, D == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;

  const problems::Problem& problem_;
  BlockedDelassus W_;
  Eigen::VectorXd r_;
};

/// Whether M and H are there and M is block diagonal.
inline bool has_velocity_form(const problems::Problem& problem) {
  return problem.is_primal() && problem.inertia().block_diagonal();
}

/// function(coupling), with the velocity coupling of the run length that suits the problem, or the
/// Delassus coupling. Precondition: has_velocity_form() where `velocity`.
template <class Function>
auto with_coupling(const problems::Problem& problem, bool velocity, Function&& function) {
  if (!velocity) return function(DelassusCoupling(problem));
  BlockedRows rows(problem);
  switch (rows.run_length()) {
    case 6:
      return function(VelocityCoupling<6>(problem, std::move(rows)));
    case 3:
      return function(VelocityCoupling<3>(problem, std::move(rows)));
    case 2:
      return function(VelocityCoupling<2>(problem, std::move(rows)));
    default:
      return function(VelocityCoupling<1>(problem, std::move(rows)));
  }
}

}  // namespace conebench::solvers
