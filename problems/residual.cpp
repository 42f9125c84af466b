#include "problems/residual.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "problems/error.h"

namespace conebench::problems {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Calls `use` with a type for one cone's part of a vector: of fixed size, which needs no memory
// from the heap, for the usual dimensions.
template <class Use>
auto with_part_of(int dim, const Use& use) {
  switch (dim) {
    case 1:
      return use(Eigen::Matrix<double, 1, 1>());
    case 2:
      return use(Eigen::Vector2d());
    case 3:
      return use(Eigen::Vector3d());
    case 6:
      return use(Eigen::Matrix<double, 6, 1>());
    default:
      return use(Eigen::VectorXd());
  }
}

Measure measure(Eigen::VectorXd per_cone) {
  Measure m;
  if (per_cone.size() > 0) {
    m.max = per_cone.maxCoeff();
    // Scaled, so that squares neither overflow nor vanish.
    if (m.max > 0.0)
      m.rms = m.max *
              std::sqrt((per_cone / m.max).squaredNorm() / static_cast<double>(per_cone.size()));
  }
  m.per_cone = std::move(per_cone);
  return m;
}

// r - P_K(r - a) with a = u_hat / lambda. Inside K it is a itself, which r - (r - a) would lose
// where r is large.
template <class Vector>
Vector natural_map(const Cone& cone, double lambda, const Vector& r, const Vector& u_hat) {
  const Vector step = u_hat / lambda;
  const Vector moved = r - step;
  if (moved(0) >= 0.0 && tangential_norm(moved) <= cone.mu * moved(0)) return step;
  Vector projected = moved;
  project(cone.mu, projected);
  return r - projected;
}

// lambda_i |r_i - P_K(r_i - u_hat_i / lambda_i)| for one cone.
template <class Vector>
double natural_error(const Cone& cone, double lambda, const Vector& r, Vector u) {
  add_de_saxce(cone.theta, u);
  if (!(lambda > 0.0)) {  // W = 0: the limit, how far u_hat is from the dual cone
    u = -u;
    project(cone.mu, u);
    return u.norm();
  }
  return lambda * natural_map(cone, lambda, r, u).norm();
}

double natural_error(const Problem& problem, int i, const Eigen::VectorXd& r,
                     const Eigen::VectorXd& u) {
  const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
  const int at = problem.start(i);
  return with_part_of(cone.dim, [&](auto part) {
    using Part = decltype(part);
    return natural_error<Part>(cone, problem.mobility()(i), r.segment(at, cone.dim),
                               u.segment(at, cone.dim));
  });
}

// max lambda_i |r_i|: the size of what cancels in u.
double reaction_rate(const Problem& problem, const Eigen::VectorXd& r) {
  double largest = 0.0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    largest = std::max(largest, problem.mobility()(i) * r.segment(problem.start(i), dim).norm());
  }
  return largest;
}

// The largest rate that cancels in u: lambda_i |r_i|, and what moving bodies carry, | |H_i| |v| |.
double cancelling_rate(const Problem& problem, const Eigen::VectorXd& r) {
  double largest = reaction_rate(problem, r);
  if (!problem.is_primal()) return largest;
  const Eigen::VectorXd carried = problem.H().cwiseAbs() * problem.velocity(r).cwiseAbs();
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    largest = std::max(largest, carried.segment(problem.start(i), dim).norm());
  }
  return largest;
}

// U, or what stands in for it when the data are all zero.
double divisor(const Problem& problem, const Eigen::VectorXd& r) {
  if (problem.rate_scale() > 0.0) return problem.rate_scale();
  const double reaction = reaction_rate(problem, r);
  return reaction > 0.0 ? reaction : 1.0;
}

// x + y - (x^2 + y^2)^{1/2} in the Jordan algebra of the second-order cone, normal first.
template <class Part>
Part fischer_burmeister(const Part& x, const Part& y) {
  Part vector = 2.0 * (x(0) * x + y(0) * y);
  vector(0) = 0.0;
  const double scalar = x.squaredNorm() + y.squaredNorm();
  const double norm = vector.norm();
  const double low = std::sqrt(std::max(0.0, scalar - norm));
  const double high = std::sqrt(scalar + norm);
  Part phi = x + y;
  phi(0) -= 0.5 * (high + low);
  if (norm > 0.0) phi -= 0.5 * (high - low) / norm * vector;
  return phi;
}

// With mu = 0 the cone is the half line: the scalar function, and r_t itself must vanish.
template <class Part>
double fischer_burmeister_square(const Cone& cone, const Part& r, const Part& u_hat) {
  Part x = r, y = u_hat;
  if (cone.mu > 0.0) {
    x(0) *= cone.mu;
    y *= cone.mu;
    y(0) = u_hat(0);
    return fischer_burmeister(x, y).squaredNorm();
  }
  const double scalar = r(0) + u_hat(0) - std::hypot(r(0), u_hat(0));
  return scalar * scalar + r.tail(r.size() - 1).squaredNorm();
}

template <class Part>
double alart_curnier_square(const Cone& cone, const Part& r, const Part& u) {
  const double un = u(0) + (cone.theta - cone.mu) * tangential_norm(u);
  const double pushed = std::max(0.0, r(0) - un);
  const Part moved = r - u;
  const double length = tangential_norm(moved);
  const double shrink = length > cone.mu * pushed ? cone.mu * pushed / length : 1.0;
  const double normal = r(0) - pushed;
  const Part tangential = r - shrink * moved;
  return normal * normal + tangential.tail(r.size() - 1).squaredNorm();
}

template <class Part>
double angle_against(const Part& r, const Part& u) {
  const double product = tangential_norm(r) * tangential_norm(u);
  if (!(product > 0.0)) return 0.0;
  const Eigen::Index n = r.size() - 1;
  return std::acos(std::clamp(-r.tail(n).dot(u.tail(n)) / product, -1.0, 1.0));
}

// What evaluate_residual() asks of one cone.
struct OfCone {
  double penetration, violation, tension, work;
  double natural_square, fischer_burmeister_square, alart_curnier_square;
};

template <class Part>
OfCone measures_of(const Cone& cone, const Part& r, const Part& u) {
  Part u_hat = u;
  add_de_saxce(cone.theta, u_hat);
  return {.penetration = std::max(0.0, -u(0)),
          .violation = std::max(0.0, tangential_norm(r) - cone.mu * r(0)),
          .tension = std::max(0.0, -r(0)),
          .work = std::abs(r.dot(u_hat)),
          .natural_square = natural_map(cone, 1.0, r, u_hat).squaredNorm(),
          .fischer_burmeister_square = fischer_burmeister_square(cone, r, u_hat),
          .alart_curnier_square = alart_curnier_square(cone, r, u)};
}

OfCone measures_of(const Problem& problem, int i, const Eigen::VectorXd& r,
                   const Eigen::VectorXd& u) {
  const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
  const int at = problem.start(i);
  return with_part_of(cone.dim, [&](auto part) {
    using Part = decltype(part);
    return measures_of<Part>(cone, r.segment(at, cone.dim), u.segment(at, cone.dim));
  });
}

// Of friction to sliding, of the cones that slide faster than `resolved`.
Eigen::VectorXd angles(const Problem& problem, double resolved, const Eigen::VectorXd& r,
                       const Eigen::VectorXd& u) {
  Eigen::VectorXd angle = Eigen::VectorXd::Zero(problem.cone_count());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
    if (!(tangential_norm(u.segment(at, dim)) > resolved)) continue;
    angle(i) = with_part_of(dim, [&](auto part) {
      using Part = decltype(part);
      return angle_against<Part>(r.segment(at, dim), u.segment(at, dim));
    });
  }
  return angle;
}

void check(const Problem& standard, const Eigen::VectorXd& r) {
  require(standard.is_standard(), standard.name(),
          "kappa > 0, expected the standard problem: Problem::shifted()");
  require(r.size() == standard.rows(), standard.name(), "r has ", r.size(), " entries, expected ",
          standard.rows());
}

Residual not_finite(const Problem& standard) {
  Residual result;
  result.finite = false;
  result.eta = measure(Eigen::VectorXd::Constant(standard.cone_count(), kInfinity));
  result.eta.max = result.eta.rms = kInfinity;
  result.attainable_eta = result.fclib = result.siconos = kInfinity;
  result.fischer_burmeister = result.alart_curnier = kInfinity;
  return result;
}

}  // namespace

double evaluate_eta(const Problem& standard, const Eigen::VectorXd& r) {
  check(standard, r);
  if (standard.cone_count() == 0) return 0.0;
  if (!r.allFinite()) return kInfinity;
  const Eigen::VectorXd u = standard.rate(r);
  if (!u.allFinite()) return kInfinity;
  double worst = 0.0;
  for (int i = 0; i < standard.cone_count(); ++i) {
    worst = std::max(worst, natural_error(standard, i, r, u));
  }
  return worst / divisor(standard, r);
}

Residual evaluate_residual(const Problem& standard, const Eigen::VectorXd& r) {
  check(standard, r);
  if (standard.cone_count() == 0) return {};
  if (!r.allFinite()) return not_finite(standard);
  const Eigen::VectorXd u = standard.rate(r);
  if (!u.allFinite()) return not_finite(standard);

  const int cones = standard.cone_count();
  const double scale = divisor(standard, r);
  Eigen::VectorXd eta(cones), penetration(cones), violation(cones), tension(cones), work(cones);
  double natural_square = 0.0, fb_square = 0.0, ac_square = 0.0;
  for (int i = 0; i < cones; ++i) {
    const OfCone of = measures_of(standard, i, r, u);
    eta(i) = natural_error(standard, i, r, u) / scale;
    penetration(i) = of.penetration;
    violation(i) = of.violation;
    tension(i) = of.tension;
    work(i) = of.work;
    natural_square += of.natural_square;
    fb_square += of.fischer_burmeister_square;
    ac_square += of.alart_curnier_square;
  }

  Residual result;
  result.eta = measure(std::move(eta));
  result.misalignment = measure(angles(standard, 10.0 * result.eta.max * scale, r, u));
  result.attainable_eta = 1e-16 * cancelling_rate(standard, r) / scale;
  const double natural = std::sqrt(natural_square);
  const double q_size = standard.q().norm();
  result.fclib = natural / std::max(q_size, 1e-300);
  result.siconos = natural / std::max({q_size, r.norm(), u.norm(), 1e-300});
  result.fischer_burmeister = fb_square / (1.0 + cones);
  result.alart_curnier = ac_square / (1.0 + cones);
  result.penetration_rate = measure(std::move(penetration));
  result.cone_violation = measure(std::move(violation));
  result.tension = measure(std::move(tension));
  result.work = measure(std::move(work));
  if (standard.is_primal()) {
    const Eigen::VectorXd v = standard.velocity(r);
    result.momentum =
        measure((standard.M() * v - standard.f() - standard.H().transpose() * r).cwiseAbs());
  }
  return result;
}

}  // namespace conebench::problems
