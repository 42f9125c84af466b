#include "solvers/prox_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/convex.h"
#include "solvers/linear/gmres.h"
#include "solvers/linear/normal_system.h"
#include "solvers/projection_jacobian.h"
#include "solvers/slope_search.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

constexpr double kSecondsPerRow = 5e-7;  // of an iteration without its linear system (work_s)
constexpr double kLeastAlpha = 1e-8, kLargestAlpha = 1e3;

// The letters are those of prox_newton.h; P_ is F + r at r_.
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
  static constexpr int kMostSteps = 10, kMostFailures = 5, kTrials = 8;
  static constexpr double kSlopeLeft = 0.5;
  static constexpr double kFastFall = 0.2, kSlowFall = 0.5, kRise = 4.0;  // of alpha
  static constexpr int kKrylov = 30;
  static constexpr double kKrylovResidual = 0.03;
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

  // -F.du at r + s dr: in the convex problem, the derivative of phi (ssnal.h) along the step.
  double slope(double s, const Eigen::VectorXd& dr, const Eigen::VectorXd& du) {
    trial_ = u_ + s * du;
    double sum = 0.0;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      auto part = P_.segment(at, dim);
      part = proximal_argument(i, trial_);
      problems::project(cone(i).mu, part);
      sum += (r_.segment(at, dim) + s * dr.segment(at, dim) - part).dot(du.segment(at, dim));
    }
    return sum;
  }

  void step(const Eigen::VectorXd& dr, const Eigen::VectorXd& du) {
    const double s =
        slope_search([&](double at) { return slope(at, dr, du); }, kSlopeLeft, kTrials);
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

  // t with t + slide(W (I + E W)^-1 kick(t)) = b.
  Eigen::VectorXd shift_change(const Eigen::VectorXd& b) {
    const auto apply = [this](const Eigen::VectorXd& t) {
      return Eigen::VectorXd(t + slide(system_.solve_rate(kick(t))));
    };
    const KrylovAnswer answer = gmres(apply, b, kKrylovResidual, kKrylov);
    gmres_ = answer.iterations;
    return answer.x;
  }

  const Problem& problem_;
  NormalSystem system_;
  BlockDiagonal E_;
  double alpha_ = kLargestFirstAlpha;
  int steps_ = 0;     // Newton steps from this centre
  int failures_ = 0;  // proximal steps in a row that were not solved
  int gmres_ = 0;     // iterations of the latest step
  Eigen::VectorXd c_, r_, u_, P_, trial_, best_;
  double best_eta_ = std::numeric_limits<double>::infinity();
  double work_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Iteration> make_proximal_newton(const Problem& problem) {
  return std::make_unique<ProximalNewton>(problem);
}

Method proximal_newton() {
  Method method{.name = "prox-newton",
                .kind = Kind::kMethod,
                .summary = "semismooth Newton on a proximal step of the Coulomb problem",
                .source =
                    "ours; Newton inside a proximal point is PPA-NSN of Acary, Bremond, Huber, "
                    "RR-9118 (2017) (not checked)",
                .parameters = {},
                .make = {}};
  method.make = [method](const Values& values) {
    return make_iterative_solver(method, values, refuse_zero_delassus, make_proximal_newton);
  };
  return method;
}

}  // namespace conebench::solvers
