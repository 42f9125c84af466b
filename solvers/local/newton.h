#pragma once

#include <Eigen/Core>

namespace conebench::solvers {

/// The data of ExactLocal's problem, d >= 2.
template <int D>
struct LocalProblem {
  Eigen::Matrix<double, D, D> W;
  double lambda = 1.0;  ///< |W|_2
  double mu = 0.0, theta = 0.0;
};

/// F(r) = 0 on one cone, at one r.
template <int D>
struct NewtonPoint {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  explicit NewtonPoint(Eigen::Index dim) : F(dim), jacobian(dim, dim) {}

  bool within(double share) const { return miss2 <= share * share * scale2; }

  Vector F;
  Matrix jacobian;      ///< an element of the generalised Jacobian
  double miss2 = 0.0;   ///< how far r is from a solution, squared, in units of r
  double scale2 = 1.0;  ///< max(|q| / lambda, |r|)^2, which miss2 is compared with
};

/// One cone by a damped semismooth Newton on F(r) = 0, any d >= 2: the problem of ExactLocal. The
/// frictionless answer has a closed form, which is all for mu = 0; other cones are iterated from r
/// on entry and, if that fails, from there. A step is halved until the merit |F| falls. Whether an
/// iterate is a solution is asked of its miss, in units of r however F is scaled.
///
/// Equation is default constructible and has, with u = W r + q: set(problem); evaluate(problem, u,
/// r, point), which fills in F and jacobian; squared_miss(problem, u, r, point).
/// No convergence proof: |F| can have local minima, and its Jacobian can be singular.
/// Cost  one d x d factorisation a step. Allocates nothing for fixed D.
template <int D, class Equation>
class NewtonLocal {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// As ExactLocal::set.
  void set(const Matrix& W, double lambda, double mu, double theta);
  const Matrix& W() const { return problem_.W; }

  /// Improves r. False if it is not a solution then: the best iterate.
  bool solve(const Vector& q, Vector& r) const;

 private:
  void evaluate(const Vector& q, const Vector& r, NewtonPoint<D>& point) const;
  bool iterate(const Vector& q, Vector& r, NewtonPoint<D>& here) const;

  LocalProblem<D> problem_;
  Equation equation_;
};

}  // namespace conebench::solvers
