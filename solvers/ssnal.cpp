#include "solvers/ssnal.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/linear/normal_system.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using State = Iteration::State;

constexpr double kSecondsPerRow = 1e-6;  // of an iteration without its linear system (work_s)
constexpr double kFirstAlpha = 1e-3, kLeastAlpha = 1e-8, kLargestAlpha = 1e3;
// A proximal step is solved when its residual is below this share of the way it went.
constexpr double kInexactness = 1e-2;
// A proximal step that took no more Newton steps than this was easy.
constexpr int kEasy = 6;
constexpr int kHard = 25;
// Residuals of r = P below this share of the reactions are rounding.
constexpr double kRounding = 1e-15;

// x <- P_K(x), J <- an element of its generalised Jacobian there.
void project_with_jacobian(double mu, Eigen::Ref<Eigen::VectorXd> x, BlockDiagonal::Block J) {
  const Eigen::Index tangents = x.size() - 1;
  const double normal = x(0), tangential = x.tail(tangents).norm();
  if (tangential <= mu * normal && normal >= 0.0) {
    J.setIdentity();
    if (mu == 0.0) J.bottomRightCorner(tangents, tangents).setZero();
    return;
  }
  J.setZero();
  if (mu * tangential <= -normal) {
    x.setZero();
    return;
  }
  const double share = 1.0 / (1.0 + mu * mu);
  const double reach = (normal + mu * tangential) * share;
  J(0, 0) = share;
  if (mu > 0.0) {
    const Eigen::VectorXd e = x.tail(tangents) / tangential;
    const double turn = mu * reach / tangential;
    J.col(0).tail(tangents) = mu * share * e;
    J.row(0).tail(tangents) = J.col(0).tail(tangents).transpose();
    J.bottomRightCorner(tangents, tangents) = (mu * mu * share - turn) * e * e.transpose();
    J.bottomRightCorner(tangents, tangents).diagonal().array() += turn;
    x.tail(tangents) = mu * reach * e;
  } else {
    x.tail(tangents).setZero();
  }
  x(0) = reach;
}

class Ssnal final : public ConvexIteration {
 public:
  explicit Ssnal(const Problem& problem) : problem_(problem), system_(problem), E_(problem) {}

  void pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) override {
    shift_ = shift;
    r_ = c_ = P_ = r;
    u_ = uP_ = problem_.rate(r);
    steps_ = 0;
  }

  State advance(double tolerance) override {
    evaluate();
    const double residual = size(P_ - r_), way = alpha_ * size(P_ - c_);
    const double enough = std::max(kInexactness * way, kRounding * size(P_));
    if (residual <= enough || (residual <= 0.1 * tolerance * problem_.rate_scale() && steps_ > 0)) {
      const bool still = way <= kRounding * size(P_) && steps_ == 0;
      next_multipliers();
      if (still) return State::kStalled;
      evaluate();
    }
    if (steps_ > kHard) harder();
    if (!factorize()) return leave(State::kDiverged);
    ++steps_;
    const Eigen::VectorXd dr = system_.solve(P_ - r_);
    const Eigen::VectorXd du = problem_.apply_delassus(dr);
    if (!dr.allFinite() || !du.allFinite()) return leave(State::kDiverged);
    step(dr, du);
    return State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return P_; }
  const Eigen::VectorXd& u() const override { return uP_; }
  double error() const override { return convex_error(problem_, shift_, P_, uP_); }
  double step_work_s() const override {
    return system_.work_s() + kSecondsPerRow * static_cast<double>(problem_.rows());
  }

 private:
  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }
  double sigma(int i) const { return 1.0 / (alpha_ * problem_.mobility()(i)); }

  // u() belongs to r() whichever way an iteration ends.
  State leave(State state) {
    uP_ = problem_.rate(P_);
    return state;
  }

  // max lambda_i |x_i|.
  double size(const Eigen::VectorXd& x) const {
    double largest = 0.0;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      largest = std::max(largest,
                         problem_.mobility()(i) * x.segment(problem_.start(i), cone(i).dim).norm());
    }
    return largest;
  }

  // P_ = P_K(c - sigma (u + t e_n)) at r_, and the scaled Jacobians.
  void evaluate() {
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      P_.segment(at, dim) = c_.segment(at, dim) - sigma(i) * u_.segment(at, dim);
      P_(at) -= sigma(i) * shift_(i);
      project_with_jacobian(cone(i).mu, P_.segment(at, dim), E_[i]);
      E_[i] *= sigma(i);
    }
  }

  // (r + s dr - P(s)).du: the derivative of phi along the step.
  double slope(double s, const Eigen::VectorXd& dr, const Eigen::VectorXd& du) const {
    double sum = 0.0;
    Eigen::VectorXd z;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      z = c_.segment(at, dim) - sigma(i) * (u_.segment(at, dim) + s * du.segment(at, dim));
      z(0) -= sigma(i) * shift_(i);
      problems::project(cone(i).mu, z);
      sum += (r_.segment(at, dim) + s * dr.segment(at, dim) - z).dot(du.segment(at, dim));
    }
    return sum;
  }

  // phi is convex along the step, so a step is long enough where its slope has mostly gone.
  void step(const Eigen::VectorXd& dr, const Eigen::VectorXd& du) {
    const double start = slope(0.0, dr, du);
    double s = 1.0, low = 0.0, high = 1.0;
    for (int trial = 0; trial < 30; ++trial) {
      const double here = slope(s, dr, du);
      if (here <= 0.5 * std::abs(start)) {
        if (s == 1.0 || here >= -0.5 * std::abs(start)) break;
        low = s;
      } else {
        high = s;
      }
      s = 0.5 * (low + high);
    }
    r_ += s * dr;
    u_ += s * du;
    if (steps_ % 10 == 0) u_ = problem_.rate(r_);
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      P_.segment(at, dim) = c_.segment(at, dim) - sigma(i) * u_.segment(at, dim);
      P_(at) -= sigma(i) * shift_(i);
      auto part = P_.segment(at, dim);
      problems::project(cone(i).mu, part);
    }
    uP_ = problem_.rate(P_);
  }

  void next_multipliers() {
    if (steps_ <= kEasy) alpha_ = std::max(0.1 * alpha_, kLeastAlpha);
    r_ = c_ = P_;
    u_ = problem_.rate(r_);
    steps_ = 0;
  }

  void harder() {
    alpha_ = std::min(10.0 * alpha_, kLargestAlpha);
    r_ = c_ = P_;
    u_ = problem_.rate(r_);
    steps_ = 0;
    evaluate();
  }

  bool factorize() {
    while (!system_.factorize(E_)) {
      if (alpha_ >= kLargestAlpha) return false;
      harder();
    }
    return true;
  }

  const Problem& problem_;
  NormalSystem system_;
  BlockDiagonal E_;
  double alpha_ = kFirstAlpha;
  int steps_ = 0;  // Newton steps of this proximal step
  Eigen::VectorXd shift_, c_, r_, u_;
  Eigen::VectorXd P_, uP_;
};

// The letters are those of ssnal.h; P_ is F + r at r_.
class ProximalNewton final : public Iteration {
 public:
  explicit ProximalNewton(const Problem& problem)
      : problem_(problem), system_(problem), E_(problem) {}

  void start(const Eigen::VectorXd& r) override {
    best_ = r;
    best_eta_ = eta_of(r, problem_.rate(r));
    alpha_ = std::clamp(kAlphaPerEta * best_eta_, kLeastAlpha, kLargestFirstAlpha);
    failures_ = 0;
    begin(best_);
  }

  State advance() override {
    evaluate();
    if (steps_ > 0 && solved()) next_centre();
    if (!system_.factorize(E_)) return fail();
    ++steps_;
    const Eigen::VectorXd b = P_ - r_;
    const Eigen::VectorXd x = b - kick(shift_change(slide(system_.solve_rate(b))));
    const Eigen::VectorXd du = system_.solve_rate(x);
    const Eigen::VectorXd dr = x - E_ * du;
    work_s_ += system_.work_s() * (1.0 + kKrylovWork * gmres_) +
               kSecondsPerRow * static_cast<double>(problem_.rows());
    if (!dr.allFinite() || !du.allFinite()) return fail();
    step(dr, du);
    const double eta = eta_of(P_, problem_.rate(P_));
    if (eta < best_eta_) {
      best_eta_ = eta;
      best_ = P_;
    }
    return steps_ < kMostSteps ? State::kRunning : fail();
  }

  const Eigen::VectorXd& r() const override { return best_; }
  double own_eta() const override { return best_eta_; }
  double work_s() const override { return work_s_; }

 private:
  static constexpr double kAlphaPerEta = 3.0, kLargestFirstAlpha = 1.0;
  // A proximal step is solved when |F| is below this share of the way it went.
  static constexpr double kSolved = 0.1;
  static constexpr int kFew = 4;  // Newton steps of an easy one
  static constexpr int kMostSteps = 10, kMostFailures = 5, kHalvings = 6;
  static constexpr double kFastFall = 0.2, kSlowFall = 0.5, kRise = 4.0;  // of alpha
  static constexpr int kKrylov = 30;
  static constexpr double kKrylovResidual = 0.1;
  // A GMRES iteration, as a share of a factorisation and a few solves.
  static constexpr double kKrylovWork = 0.1;

  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }
  double sigma(int i) const { return 1.0 / (alpha_ * problem_.mobility()(i)); }
  double eta_of(const Eigen::VectorXd& r, const Eigen::VectorXd& u) const {
    return convex_error(problem_, de_saxce_shift(problem_, u), r, u);
  }
  // (sum lambda_i^2 |x_i|^2)^(1/2).
  double size(const Eigen::VectorXd& x) const {
    double sum = 0.0;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const double part = problem_.mobility()(i) * x.segment(problem_.start(i), cone(i).dim).norm();
      sum += part * part;
    }
    return std::sqrt(sum);
  }

  void begin(const Eigen::VectorXd& centre) {
    c_ = r_ = centre;
    u_ = problem_.rate(r_);
    steps_ = 0;
    latest_ = previous_ = std::numeric_limits<double>::infinity();
  }

  bool solved() const { return size(P_ - r_) <= kSolved * alpha_ * size(P_ - c_); }

  void next_centre() {
    alpha_ = std::max(alpha_ * (steps_ <= kFew ? kFastFall : kSlowFall), kLeastAlpha);
    failures_ = 0;
    const Eigen::VectorXd centre = P_;
    begin(centre);
    evaluate();
  }

  State fail() {
    alpha_ = std::min(kRise * alpha_, kLargestAlpha);
    begin(best_);
    return ++failures_ < kMostFailures ? State::kRunning : State::kStalled;
  }

  Eigen::VectorXd proximal_argument(int i, const Eigen::VectorXd& u) const {
    const int at = problem_.start(i), dim = cone(i).dim;
    Eigen::VectorXd z = c_.segment(at, dim) - sigma(i) * u.segment(at, dim);
    z(0) -= sigma(i) * cone(i).theta * u.segment(at + 1, dim - 1).norm();
    return z;
  }

  void evaluate() {
    P_.resize(problem_.rows());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      auto part = P_.segment(problem_.start(i), cone(i).dim);
      part = proximal_argument(i, u_);
      project_with_jacobian(cone(i).mu, part, E_[i]);
      E_[i] *= sigma(i);
    }
  }

  // |F| at r + s dr; P_ is left there.
  double merit(double s, const Eigen::VectorXd& dr, const Eigen::VectorXd& du) {
    const Eigen::VectorXd u = u_ + s * du;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      auto part = P_.segment(problem_.start(i), cone(i).dim);
      part = proximal_argument(i, u);
      problems::project(cone(i).mu, part);
    }
    return size(P_ - r_ - s * dr);
  }

  void step(const Eigen::VectorXd& dr, const Eigen::VectorXd& du) {
    if (steps_ == 1) latest_ = size(P_ - r_);
    const double reference = steps_ == 1 ? latest_ : std::max(latest_, previous_);
    double s = 1.0, here = merit(s, dr, du);
    for (int trial = 0; trial < kHalvings && !(here < reference); ++trial) {
      s *= 0.5;
      here = merit(s, dr, du);
    }
    previous_ = latest_;
    latest_ = here;
    r_ += s * dr;
    u_ += s * du;
  }

  // theta u_t.du_t / |u_t| of each cone: the change of t along du.
  Eigen::VectorXd slide(const Eigen::VectorXd& du) const {
    Eigen::VectorXd t = Eigen::VectorXd::Zero(problem_.cone_count());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i) + 1, tangents = cone(i).dim - 1;
      const double length = u_.segment(at, tangents).norm();
      if (length == 0.0) continue;
      t(i) = cone(i).theta * u_.segment(at, tangents).dot(du.segment(at, tangents)) / length;
    }
    return t;
  }

  // E e_n t.
  Eigen::VectorXd kick(const Eigen::VectorXd& t) const {
    Eigen::VectorXd x(problem_.rows());
    for (int i = 0; i < problem_.cone_count(); ++i) {
      x.segment(problem_.start(i), cone(i).dim) = t(i) * E_[i].col(0);
    }
    return x;
  }

  // t with t + slide(W (I + E W)^-1 kick(t)) = b, by GMRES.
  Eigen::VectorXd shift_change(const Eigen::VectorXd& b) {
    gmres_ = 0;
    const double size = b.norm();
    if (!(size > 0.0) || !std::isfinite(size)) return Eigen::VectorXd::Zero(b.size());
    Eigen::MatrixXd basis(b.size(), kKrylov + 1);
    Eigen::MatrixXd image = Eigen::MatrixXd::Zero(kKrylov + 1, kKrylov);
    Eigen::VectorXd target = Eigen::VectorXd::Zero(kKrylov + 1), weights;
    target(0) = size;
    basis.col(0) = b / size;
    for (int k = 0; k < kKrylov; ++k) {
      ++gmres_;
      Eigen::VectorXd next = basis.col(k) + slide(system_.solve_rate(kick(basis.col(k))));
      for (int j = 0; j <= k; ++j) {
        image(j, k) = basis.col(j).dot(next);
        next -= image(j, k) * basis.col(j);
      }
      image(k + 1, k) = next.norm();
      const auto small = image.topLeftCorner(k + 2, k + 1);
      weights = small.householderQr().solve(target.head(k + 2));
      const double left = (target.head(k + 2) - small * weights).norm();
      if (left <= kKrylovResidual * size || !(image(k + 1, k) > 0.0)) break;
      basis.col(k + 1) = next / image(k + 1, k);
    }
    return basis.leftCols(weights.size()) * weights;
  }

  const Problem& problem_;
  NormalSystem system_;
  BlockDiagonal E_;
  double alpha_ = kFirstAlpha;
  int steps_ = 0;                         // Newton steps from this centre
  int failures_ = 0;                      // proximal steps in a row that were not solved
  int gmres_ = 0;                         // iterations of the latest step
  double latest_ = 0.0, previous_ = 0.0;  // |F|
  Eigen::VectorXd c_, r_, u_, P_, best_;
  double best_eta_ = std::numeric_limits<double>::infinity();
  double work_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Iteration> make_proximal_newton(const Problem& problem) {
  return std::make_unique<ProximalNewton>(problem);
}

std::unique_ptr<ConvexIteration> make_ssnal(const Problem& problem) {
  return std::make_unique<Ssnal>(problem);
}

}  // namespace conebench::solvers
