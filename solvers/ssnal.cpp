#include "solvers/ssnal.h"

#include <algorithm>
#include <cmath>

#include "solvers/linear/normal_system.h"
#include "solvers/projection_jacobian.h"
#include "solvers/slope_search.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using State = Iteration::State;

constexpr double kSecondsPerRow = 5e-7;  // of an iteration without its linear system (work_s)
constexpr double kFirstAlpha = 1e-3, kLeastAlpha = 1e-8, kLargestAlpha = 1e3;
// A proximal step is solved when its residual is below this share of the way it went.
constexpr double kInexactness = 1e-2;
// A proximal step that took no more Newton steps than this was easy.
constexpr int kEasy = 6;
constexpr int kHard = 25;
// Residuals of r = P below this share of the reactions are rounding.
constexpr double kRounding = 1e-15;

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

  // phi is convex along the step.
  void step(const Eigen::VectorXd& dr, const Eigen::VectorXd& du) {
    const double s = slope_search([&](double at) { return slope(at, dr, du); }, 0.5, 30);
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

}  // namespace

std::unique_ptr<ConvexIteration> make_ssnal(const Problem& problem) {
  return std::make_unique<Ssnal>(problem);
}

}  // namespace conebench::solvers
