#include "solvers/pyramid_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
constexpr double kPi = std::numbers::pi;

// x_t in the frame of the face that its direction points at.
struct FaceFrame {
  FaceFrame(int faces, const Eigen::Vector2d& x) {
    const double sector = 2.0 * kPi / faces;
    const double angle = (std::floor(std::atan2(x(1), x(0)) / sector) + 0.5) * sector;
    out << std::cos(angle), std::sin(angle);
    along << -out(1), out(0);
    p = out.dot(x);
    s = along.dot(x);
  }
  Eigen::Vector2d out, along;  // through the middle of the face; along it
  double p, s;                 // x_t = p out + s along
};

}  // namespace

PyramidLaw::PyramidLaw(int faces)
    : faces_(faces), cosine_(std::cos(kPi / faces)), sine_(std::sin(kPi / faces)) {}

std::optional<std::string> PyramidLaw::refuses(const Problem& problem) {
  for (const Cone& cone : problem.cones()) {
    if (cone.dim <= 3) continue;
    return fmt::format(
        "a cone has d = {}, a pyramid takes d = 1, 2 and 3: its edges are directions in a plane",
        cone.dim);
  }
  return std::nullopt;
}

Eigen::MatrixXd PyramidLaw::directions(int dim) const {
  if (dim == 1) return Eigen::MatrixXd(0, 0);
  if (dim == 2) return Eigen::RowVector2d(1.0, -1.0);
  Eigen::MatrixXd d(2, faces_);
  for (int j = 0; j < faces_; ++j) {
    const double angle = 2.0 * kPi * j / faces_;
    d.col(j) << std::cos(angle), std::sin(angle);
  }
  return d;
}

void PyramidLaw::project(double mu, Eigen::Ref<Eigen::VectorXd> r) const {
  if (r.size() < 3) {
    problems::project(mu, r);
    return;
  }
  const FaceFrame at(faces_, r.tail<2>());
  const double slope = mu * cosine_, width = mu * sine_, side = std::copysign(1.0, at.s);
  if (r(0) >= 0.0 && at.p <= slope * r(0)) return;
  // On the plane of the face, and then, if beside it, on its nearer edge.
  double normal = (r(0) + slope * at.p) / (1.0 + slope * slope), s = at.s;
  if (std::abs(s) > width * normal) {
    normal = std::max(0.0, (r(0) + slope * at.p + width * std::abs(s)) / (1.0 + mu * mu));
    s = side * width * normal;
  }
  r(0) = normal;
  r.tail<2>() = slope * normal * at.out + s * at.along;
}

void PyramidLaw::shift_rate(double theta, Eigen::Ref<Eigen::VectorXd> u) const {
  if (u.size() < 3) {
    problems::add_de_saxce(theta, u);
    return;
  }
  const FaceFrame at(faces_, -u.tail<2>());
  u(0) += theta * (at.p * cosine_ + std::abs(at.s) * sine_);
}

double PyramidLaw::eta(const Problem& problem, const Eigen::VectorXd& r) const {
  return eta(problem, r, problem.rate(r));
}

double PyramidLaw::eta(const Problem& problem, const Eigen::VectorXd& r,
                       const Eigen::VectorXd& u) const {
  double worst = 0.0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const int at = problem.start(i);
    const double lambda = problem.mobility()(i);
    Eigen::VectorXd z = u.segment(at, cone.dim);
    shift_rate(cone.theta, z);
    z = r.segment(at, cone.dim) - z / lambda;
    project(cone.mu, z);
    const double error = lambda * (r.segment(at, cone.dim) - z).norm();
    if (std::isnan(error)) return error;
    worst = std::max(worst, error);
  }
  return problem.rate_scale() > 0.0 ? worst / problem.rate_scale() : worst;
}

}  // namespace conebench::solvers
