#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace conebench::solvers {

/// F(r) = 0 on one cone, at one r.
template <int D>
struct NewtonPoint {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  explicit NewtonPoint(Eigen::Index dim) : F(dim), jacobian(dim, dim) {}

  bool within(double share) const { return F.norm() <= share * scale; }

  Vector F;
  Matrix jacobian;     ///< an element of the generalised Jacobian
  double scale = 1.0;  ///< the size that |F| is compared with
};

/// Semismooth Newton from r with the merit |F|: each step is halved until the merit falls.
/// `evaluate(r, point)` fills in a NewtonPoint. Leaves the best iterate in r and answers whether it
/// is a solution: |F| <= kAccepted scale, after steps until |F| <= kGoal scale or no step helps.
template <int D, class Evaluate>
bool damped_newton(const Evaluate& evaluate, Eigen::Matrix<double, D, 1>& r) {
  constexpr int kSteps = 60, kHalvings = 12;
  constexpr double kGoal = 1e-15, kAccepted = 1e-11, kSufficientDecrease = 1e-4;
  NewtonPoint<D> here(r.size()), there(r.size());
  evaluate(r, here);
  for (int step = 0; step < kSteps && !here.within(kGoal); ++step) {
    const Eigen::Matrix<double, D, 1> direction = here.jacobian.partialPivLu().solve(here.F);
    if (!direction.allFinite()) break;
    Eigen::Matrix<double, D, 1> next(r.size());
    double length = 1.0;
    for (int halving = 0; halving <= kHalvings; ++halving, length *= 0.5) {
      next = r - length * direction;
      evaluate(next, there);
      if (there.F.norm() <= (1.0 - kSufficientDecrease * length) * here.F.norm()) break;
    }
    if (!(there.F.norm() < here.F.norm())) break;
    r = next;
    std::swap(here, there);
  }
  return here.within(kAccepted);
}

/// What the local Newtons share: one cone of d >= 2, u = W r + q. The frictionless answer has a
/// closed form, which is all for mu = 0; other cones are iterated from r on entry and, if that
/// fails, from there. r is left at the better end; false if neither is a solution.
template <int D, class Evaluate>
bool solve_cone_by_newton(const Evaluate& evaluate, double Wnn, double mu,
                          const Eigen::Matrix<double, D, 1>& q, Eigen::Matrix<double, D, 1>& r) {
  Eigen::Matrix<double, D, 1> frictionless = q;
  frictionless.setZero();
  frictionless(0) = q(0) < 0.0 && Wnn > 0.0 ? -q(0) / Wnn : 0.0;
  if (mu == 0.0) {
    r = frictionless;
    return q(0) >= 0.0 || Wnn > 0.0;
  }
  if (damped_newton<D>(evaluate, r)) return true;
  if (damped_newton<D>(evaluate, frictionless)) {
    r = frictionless;
    return true;
  }
  NewtonPoint<D> first(r.size()), second(r.size());
  evaluate(r, first);
  evaluate(frictionless, second);
  if (second.F.norm() < first.F.norm()) r = frictionless;
  return false;
}

}  // namespace conebench::solvers
