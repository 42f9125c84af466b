#pragma once

#include "solvers/blocked_rows.h"
#include "solvers/with_dimension.h"

namespace conebench::solvers {

/// How a cone's rate feels the other cones, for one-cone-at-a-time methods. Both couplings have
///
///   clear()           the state without reactions; first of all
///   diagonal_block(i) W_ii
///   rate(i, at, u)    u_i at the current state; `at` is the cone's first row
///   normal_rate(i, at, dim)  its first entry alone, for much less
///   moved(i, change)  r_i has moved by `change`
///
/// with u and change of fixed or dynamic size.

/// From mass-scaled velocities: what a cone costs is its few bodies or nodes. `Products` are those
/// that suit the rows (with_products).
template <class Products>
class VelocityCoupling {
 public:
  VelocityCoupling(const problems::Problem& problem, BlockedRows rows)
      : problem_(problem),
        w_(problem.w()),
        rows_(std::move(rows)),
        free_(rows_.free_velocity(problem)) {}

  const BlockedRows& rows() const { return rows_; }
  /// Of the blocks, their indices and y.
  std::size_t bytes() const {
    return rows_.bytes() + sizeof(double) * static_cast<std::size_t>(rows_.scaled_dofs());
  }

  void clear() { y_ = free_; }

  Eigen::MatrixXd diagonal_block(int i) const {
    return rows_.diagonal_block(i, problem_.cones()[static_cast<std::size_t>(i)].dim);
  }

  double normal_rate(int i, int at, int dim) const {
    return w_(at) + Products::normal_rate(rows_, i, dim, y_.data());
  }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    Vector sum = w_.segment<D>(at, u.size());
    Products::add_rate(rows_, i, y_.data(), sum);
    u = sum;
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    Products::add_reaction(rows_, i, change, y_.data());
  }

 private:
  const problems::Problem& problem_;
  const Eigen::VectorXd& w_;
  BlockedRows rows_;
  Eigen::VectorXd free_, y_;
};

/// From rows of W.
class DelassusCoupling {
 public:
  explicit DelassusCoupling(const problems::Problem& problem)
      : problem_(problem), q_(problem.q()), W_(problem) {}

  const BlockedDelassus& blocks() const { return W_; }

  void clear() { r_.setZero(problem_.rows()); }

  Eigen::MatrixXd diagonal_block(int i) const { return W_.diagonal_block(problem_, i); }

  double normal_rate(int i, int at, int dim) const { return q_(at) + W_.normal_rate(i, dim, r_); }

  template <class Vector>
  void rate(int i, int at, Vector& u) const {
    constexpr int D = Vector::RowsAtCompileTime;
    Vector sum = q_.segment<D>(at, u.size());
    W_.add_rate(i, r_, sum);
    u = sum;
  }

  template <class Vector>
  void moved(int i, const Vector& change) {
    r_.segment<Vector::RowsAtCompileTime>(problem_.start(i), change.size()) += change;
  }

 private:
  const problems::Problem& problem_;
  const Eigen::VectorXd& q_;
  BlockedDelassus W_;
  Eigen::VectorXd r_;
};

/// Adds r_i to a state without it.
template <class Coupling>
void add_reaction(Coupling& coupling, const problems::Problem& problem, int i,
                  const Eigen::VectorXd& r) {
  const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
  with_dimension(dim, [&]<int D>() {
    const auto ri = r.segment<D>(problem.start(i), dim);
    if ((ri.array() != 0.0).any()) coupling.moved(i, ri);
  });
}

/// Brings the state to reactions r, without the rounding gathered so far.
template <class Coupling>
void refresh(Coupling& coupling, const problems::Problem& problem, const Eigen::VectorXd& r) {
  coupling.clear();
  for (int i = 0; i < problem.cone_count(); ++i) add_reaction(coupling, problem, i, r);
}

/// Whether M and H are there and M is block diagonal.
inline bool has_velocity_form(const problems::Problem& problem) {
  return problem.is_primal() && problem.inertia().block_diagonal();
}

/// function(coupling), with the velocity coupling that suits the problem, or the
/// Delassus coupling. Precondition: has_velocity_form() where `velocity`.
template <class Function>
auto with_coupling(const problems::Problem& problem, bool velocity, Function&& function) {
  if (!velocity) return function(DelassusCoupling(problem));
  BlockedRows rows(problem);
  return with_products(rows, [&]<class Products>() {
    return function(VelocityCoupling<Products>(problem, std::move(rows)));
  });
}

}  // namespace conebench::solvers
