#include "solvers/interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/central_pair.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using State = Iteration::State;

constexpr double kSecondsPerRow = 8e-7;  // of an iteration without its linear system (work_s)
// Share of the way to the cone's boundary; of the path with the shift as an unknown less.
constexpr double kToBoundary = 0.995, kToBoundaryWithShift = 0.98;
constexpr double kLeastPush = 1e-12, kLargestPush = 1.0;  // into the interior, as shares of U
// Cones of less mobility than this share of the largest start from no larger a reaction.
constexpr double kLeastMobility = 1e-4;
constexpr double kInside = 4e-16;  // least relative distance from the boundary
constexpr int kRefinements = 3;
constexpr double kRounding = 2e-15;  // of a sum, as a share of the sum of its terms' sizes
constexpr int kShortenings = 8;
constexpr double kShortestStep = 1e-8;
constexpr double kShort = 0.3;  // a step below this is better gone with the shift held
constexpr int kCorrections = 4;
constexpr double kWorthwhile = 1.02;  // further, by this factor, is worth a correction

}  // namespace

InteriorPoint::InteriorPoint(const Problem& problem, ScaledSystem::Form form, bool coulomb)
    : problem_(problem),
      coulomb_(coulomb),
      least_mobility_(problem.cone_count() > 0 ? kLeastMobility * problem.mobility().maxCoeff()
                                               : 0.0),
      system_(problem, form, !coulomb),
      R_(problem),
      C_(problem),
      scalings_(problem) {}

void InteriorPoint::pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) {
  posed_ = shift;
  const Eigen::VectorXd u = problem_.rate(r);
  const Eigen::VectorXd t = coulomb_ ? de_saxce_shift(problem_, u) : posed_;
  const double violation = convex_error(problem_, t, r, u);
  r_ = x_ = Eigen::VectorXd::Zero(problem_.rows());
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const int at = problem_.start(i), dim = cone(i).dim;
    const double lambda = problem_.mobility()(i);
    Eigen::VectorXd z = r.segment(at, dim) - u.segment(at, dim) / lambda;
    z(0) -= t(i) / lambda;
    Eigen::VectorXd projected = z;
    problems::project(cone(i).mu, projected);
    r_.segment(at, dim) = projected;
    x_.segment(at, dim) = lambda * (projected - z);
    if (coulomb_) {
      centre_cone(i);
    } else {
      push_inside(i, 10.0 * violation);
    }
  }
  keep_inside();
  u_ = problem_.rate(r_);
  update();
}

void InteriorPoint::centre_cone(int i) {
  const int at = problem_.start(i), dim = cone(i).dim;
  const double gap = start_ * scale();
  centre(cone(i).mu, problem_.mobility()(i), gap * gap / start_mobility(i), r_.segment(at, dim),
         x_.segment(at, dim));
}

// As far from the boundary in either cone, whatever mu.
void InteriorPoint::push_inside(int i, double share) {
  const double push = std::clamp(share, kLeastPush, kLargestPush) * scale();
  r_(problem_.start(i)) +=
      push / start_mobility(i) * std::max(1.0, 1.0 / std::max(cone(i).mu, 0.1));
  x_(problem_.start(i)) += push * std::max(1.0, cone(i).mu);
}

double InteriorPoint::start_mobility(int i) const {
  return std::max(problem_.mobility()(i), least_mobility_);
}

State InteriorPoint::advance(double) {
  if (problem_.cone_count() == 0) return State::kStalled;
  scalings_.set(r_, x_);
  scalings_.write_R(R_);
  const Eigen::VectorXd residual = residual_above_rounding();
  if (!residual.allFinite()) return State::kStalled;
  directions_ = 0;
  double step = find_direction(residual, !coulomb_);
  if (coulomb_ && step < kShort) {
    hold_shift();
    step = find_direction(residual, true);
  }
  if (step < kShortestStep) return State::kStalled;
  r_ += step * direction_.dr;
  x_ += step * direction_.dx;
  keep_inside();
  u_ = problem_.rate(r_);
  update();
  return State::kRunning;
}

double InteriorPoint::step_work_s() const {
  return directions_ * (system_.work_s() + kSecondsPerRow * static_cast<double>(problem_.rows()));
}

double InteriorPoint::eta() const {
  return convex_error(problem_, de_saxce_shift(problem_, u_), r_, u_);
}

double InteriorPoint::smoothing_of(int i) const {
  const double root = std::sqrt(std::max(nu_, 0.0) * problem_.mobility()(i));
  return smoothing_share_ * root * std::min(1.0, root / scale());
}

// Gap, shift and its derivative at the current iterate.
void InteriorPoint::update() {
  nu_ = r_.dot(x_) / std::max(problem_.cone_count(), 1);
  smoothing_ = 0.0;
  hold_shift();
  if (coulomb_) posed_.resize(problem_.cone_count());
  for (int i = 0; coulomb_ && i < problem_.cone_count(); ++i) {
    const int at = problem_.start(i);
    const double eps = smoothing_of(i), theta = cone(i).theta;
    double square = eps * eps;
    for (int k = 1; k < cone(i).dim; ++k) square += u_(at + k) * u_(at + k);
    const double length = std::sqrt(square);
    smoothing_ = std::max(smoothing_, eps);
    posed_(i) = theta * length;
    auto C = C_[i];
    for (int k = 1; length > 0.0 && k < cone(i).dim; ++k) C(0, k) = theta / length * u_(at + k);
  }
  error_ = convex_error(problem_, posed_, r_, u_);
}

// C = I: directions in which the shift stays as it is.
void InteriorPoint::hold_shift() {
  for (int i = 0; i < problem_.cone_count(); ++i) C_[i].setIdentity();
}

// e, its entries of the size of the rounding in u taken as zero: where x is smaller than that
// they would swamp the direction.
Eigen::VectorXd InteriorPoint::residual_above_rounding() const {
  const Eigen::VectorXd terms =
      problem_.is_primal()
          ? Eigen::VectorXd(problem_.H().cwiseAbs() * problem_.velocity(r_).cwiseAbs() +
                            problem_.w().cwiseAbs())
          : Eigen::VectorXd(problem_.W().cwiseAbs() * r_.cwiseAbs() + problem_.q().cwiseAbs());
  Eigen::VectorXd e = u_ + shift_normals() - x_;
  for (Eigen::Index row = 0; row < e.size(); ++row) {
    if (std::abs(e(row)) <= kRounding * terms(row)) e(row) = 0.0;
  }
  return e;
}

Eigen::VectorXd InteriorPoint::shift_normals() const {
  Eigen::VectorXd t = Eigen::VectorXd::Zero(problem_.rows());
  for (int i = 0; i < problem_.cone_count(); ++i) t(problem_.start(i)) = posed_(i);
  return t;
}

// Predicts and corrects. Returns how far the direction may be gone; 0 where there is none.
double InteriorPoint::find_direction(const Eigen::VectorXd& residual, bool shift_held) {
  ++directions_;
  if (!affine_direction(residual)) return 0.0;
  const double affine = step_length(1.0);
  const double sigma = std::pow(1.0 - affine, 3);
  direction((1.0 - sigma) * residual, sigma * nu_, affine * affine);
  if (!direction_.dr.allFinite() || !direction_.dx.allFinite()) return 0.0;
  double step = to_boundary();
  for (int k = 0; k < kCorrections; ++k) {
    const Direction before = direction_;
    direction((1.0 - sigma) * residual, sigma * nu_, step);
    const double further = to_boundary();
    if (!(further > kWorthwhile * step)) {
      direction_ = before;
      break;
    }
    step = further;
  }
  return shift_held ? step : shorten(step, 1.0 - sigma, residual.norm());
}

// False where the system has no factor in doubles.
bool InteriorPoint::affine_direction(const Eigen::VectorXd& residual) {
  for (;;) {
    const bool factorised = system_.factorize(R_, C_);
    if (factorised && direction(residual, 0.0, 0.0) <= system_.fine()) return true;
    if (!system_.can_be_finer()) return factorised;
    system_.be_finer();
  }
}

// dr~ + dx~ = lambda \ (target - lambda o lambda - correction * last dx~ o last dr~) with
// dx = C W dr + e gives (I + R C W R^T) dr~ = that - R e, refined against W itself.
// Returns the relative residual that is left.
double InteriorPoint::direction(const Eigen::VectorXd& residual, double target, double correction) {
  Direction& d = direction_;
  Eigen::VectorXd z = Eigen::VectorXd::Zero(problem_.rows());
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const Eigen::Index at = problem_.start(i), size = scalings_.size(i);
    with_dimension(size, [&]<int D>() {
      using Vector = Eigen::Matrix<double, D, 1>;
      const Vector lambda = scalings_.lambda().segment<D>(at, size);
      Vector c = -jordan_product(lambda, lambda);
      c(0) += target;
      if (correction > 0.0) {
        const Vector dx = d.scaled_dx.segment<D>(at, size), dr = d.scaled_dr.segment<D>(at, size);
        c -= correction * jordan_product(dx, dr);
      }
      z.segment<D>(at, size) = jordan_divide(lambda, c);
    });
  }
  const Eigen::VectorXd rhs = z - R_ * residual;
  auto move = [&](const Eigen::VectorXd& scaled) {
    d.scaled_dr = scaled;
    d.dr = R_.transpose_times(scaled);
    d.du = problem_.apply_delassus(d.dr);
    d.dx = C_ * d.du;
    return Eigen::VectorXd(rhs - scaled - R_ * d.dx);
  };
  Eigen::VectorXd left = move(system_.solve(rhs));
  for (int k = 0; k < kRefinements && left.norm() > system_.refined() * rhs.norm(); ++k) {
    const Eigen::VectorXd before = d.scaled_dr;
    const Eigen::VectorXd left_then = move(before + system_.solve(left));
    if (!(left_then.norm() < left.norm())) {
      move(before);
      break;
    }
    left = left_then;
  }
  d.dx += residual;
  d.scaled_dx = z - d.scaled_dr;
  return left.norm() / std::max(rhs.norm(), std::numeric_limits<double>::min());
}

double InteriorPoint::to_boundary() const {
  const double share = coulomb_ ? kToBoundaryWithShift : kToBoundary;
  return std::min(share * step_length(1.0 / share), 1.0);
}

// The longest step that keeps r and x in their cones.
double InteriorPoint::step_length(double longest) const {
  double step = longest;
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const Eigen::Index at = problem_.start(i), size = scalings_.size(i);
    with_dimension(size, [&]<int D>() {
      const auto lambda = scalings_.lambda().segment<D>(at, size);
      step = longest_step(lambda, direction_.scaled_dr.segment<D>(at, size), step);
      step = longest_step(lambda, direction_.scaled_dx.segment<D>(at, size), step);
    });
  }
  return step;
}

// Rounding may put an iterate on the boundary of its cone, where the scaling does not exist.
void InteriorPoint::keep_inside() {
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const double mu = cone(i).mu;
    auto r = r_.segment(problem_.start(i), cone(i).dim);
    auto x = x_.segment(problem_.start(i), cone(i).dim);
    if (mu == 0.0) {
      r.tail(cone(i).dim - 1).setZero();
      continue;
    }
    r(0) = std::max(r(0), problems::tangential_norm(r) / mu * (1.0 + kInside));
    x(0) = std::max(x(0), mu * problems::tangential_norm(x) * (1.0 + kInside));
  }
}

// The residual of the nonlinear x = u + theta |u_t|_eps e_n must fall, or stay below the gap.
double InteriorPoint::shorten(double step, double share, double before) const {
  const double rounding = 1e-15 * std::max(u_.norm(), scale());
  const double gap = std::sqrt(std::max(nu_, 0.0) * problem_.mobility().maxCoeff());  // as a rate
  for (int trial = 0; trial < kShortenings; ++trial) {
    double square = 0.0;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      const double eps = smoothing_of(i);
      double slip_square = eps * eps, normal = 0.0;
      for (int k = 0; k < dim; ++k) {
        const double u = u_(at + k) + step * direction_.du(at + k);
        const double e = u - x_(at + k) - step * direction_.dx(at + k);
        if (k == 0) {
          normal = e;
        } else {
          square += e * e;
          slip_square += u * u;
        }
      }
      normal += cone(i).theta * std::sqrt(slip_square);
      square += normal * normal;
    }
    const double allowed = (1.0 - 0.1 * share * step) * before + rounding;
    if (std::sqrt(square) <= std::max(allowed, 0.1 * gap)) return step;
    step *= 0.5;
  }
  return step;
}

}  // namespace conebench::solvers
