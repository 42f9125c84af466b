#pragma once

#include <Eigen/Core>
#include <cmath>

#include "solvers/local/outcome.h"

namespace conebench::solvers {

/// One cone whose W_ii is diag(W_nn, s I), both positive, under Coulomb's law (theta = mu): every
/// contact between spheres. Then u = 0 asks for r - W_ii^-1 u, whose normal part stays and whose
/// tangential part is cut back to mu r_n, without a change of direction.
///
/// Interface as OneCone's (one_cone.h).  Memory 24 bytes.
class IsotropicCone {
 public:
  IsotropicCone(double Wnn, double s, double mu)
      : normal_(1.0 / Wnn), tangential_(1.0 / s), mu_(mu) {}

  bool stays_open(double un) const { return un >= 0.0; }

  template <class Vector>
  LocalOutcome solve(const Vector& u, Vector& r) const {
    const double rn = r(0) - normal_ * u(0);
    if (rn <= 0.0) {  // not where rn is NaN: that shows in the answer
      r.setZero();
      return LocalOutcome::kDone;
    }
    Vector answer = r - tangential_ * u;
    double square = 0.0;
    for (Eigen::Index k = 1; k < r.size(); ++k) square += answer(k) * answer(k);
    const double largest = mu_ * rn;
    const bool slides = square > largest * largest;
    if (slides) answer *= largest / std::sqrt(square);
    answer(0) = rn;
    r = answer;
    return LocalOutcome::kDone;
  }

 private:
  double normal_, tangential_;  // 1 / W_nn, 1 / s
  double mu_;
};

}  // namespace conebench::solvers
