#pragma once

// The members of NewtonLocal, for the files that instantiate it.

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "solvers/local/newton.h"

namespace conebench::solvers {

template <int D, class Equation>
void NewtonLocal<D, Equation>::set(const Matrix& W, double lambda, double mu, double theta) {
  problem_ = {W, lambda, mu, theta};
  equation_.set(problem_);
}

template <int D, class Equation>
void NewtonLocal<D, Equation>::evaluate(const Vector& q, const Vector& r,
                                        NewtonPoint<D>& point) const {
  const double lambda = problem_.lambda;
  const Vector u = problem_.W * r + q;
  equation_.evaluate(problem_, u, r, point);
  point.miss2 = equation_.squared_miss(problem_, u, r, point);
  point.scale2 = std::max(q.squaredNorm() / (lambda * lambda), r.squaredNorm());
}

// Leaves the last iterate, which is the best, in r and `here`.
template <int D, class Equation>
bool NewtonLocal<D, Equation>::iterate(const Vector& q, Vector& r, NewtonPoint<D>& here) const {
  constexpr int kSteps = 60, kHalvings = 12;
  constexpr double kSufficientDecrease = 1e-4;
  // Of the miss: no further steps; a solution.
  constexpr double kGoal = 1e-15, kAccepted = 1e-11;
  NewtonPoint<D> there(r.size());
  evaluate(q, r, here);
  for (int step = 0; step < kSteps && !here.within(kGoal); ++step) {
    const Vector direction = here.jacobian.partialPivLu().solve(here.F);
    if (!direction.allFinite()) break;
    Vector next(r.size());
    double length = 1.0;
    for (int halving = 0; halving <= kHalvings; ++halving, length *= 0.5) {
      next = r - length * direction;
      evaluate(q, next, there);
      if (there.F.norm() <= (1.0 - kSufficientDecrease * length) * here.F.norm()) break;
    }
    if (!(there.F.norm() < here.F.norm())) break;
    r = next;
    std::swap(here, there);
  }
  return here.within(kAccepted);
}

template <int D, class Equation>
bool NewtonLocal<D, Equation>::solve(const Vector& q, Vector& r) const {
  const double Wnn = problem_.W(0, 0);
  Vector frictionless = q;
  frictionless.setZero();
  frictionless(0) = q(0) < 0.0 && Wnn > 0.0 ? -q(0) / Wnn : 0.0;
  if (problem_.mu == 0.0) {
    r = frictionless;
    return q(0) >= 0.0 || Wnn > 0.0;
  }
  NewtonPoint<D> first(r.size()), second(r.size());
  if (iterate(q, r, first)) return true;
  const bool solved = iterate(q, frictionless, second);
  if (solved || second.F.norm() < first.F.norm()) r = frictionless;
  return solved;
}

}  // namespace conebench::solvers
