#include "solvers/newton/newton.h"

#include <algorithm>

#include "solvers/convex.h"
#include "solvers/gs.h"
#include "solvers/newton/alart_curnier.h"
#include "solvers/newton/fischer_burmeister.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

constexpr double kSecondsPerRow = 1e-6;  // of an iteration without its linear system (work_s)
constexpr double kLeastAlpha = 1e-10, kLargestAlpha = 100.0;
constexpr double kGrowth = 10.0;
// Below kShort the model failed; from kWhole on it held.
constexpr double kShort = 0.25, kWhole = 0.5;
// After a whole step; the first if the merit fell by more than a tenth.
constexpr double kFastDecay = 0.3, kDecay = 0.5;

std::unique_ptr<const ConeFunction> make_function(const NewtonSettings& settings) {
  switch (settings.function) {
    case NewtonSettings::Function::kAlartCurnier:
      return std::make_unique<AlartCurnier>(AlartCurnier::Radius::kAlartCurnier, settings.rho);
    case NewtonSettings::Function::kJeanMoreau:
      return std::make_unique<AlartCurnier>(AlartCurnier::Radius::kJeanMoreau, settings.rho);
    case NewtonSettings::Function::kFischerBurmeister:
      return std::make_unique<FischerBurmeister>();
  }
  return nullptr;
}

Eigen::VectorXd mobility_per_row(const Problem& problem) {
  Eigen::VectorXd lambda(problem.rows());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    lambda.segment(problem.start(i), dim).setConstant(problem.mobility()(i));
  }
  return lambda;
}

double half_square(const Eigen::VectorXd& x) { return 0.5 * x.squaredNorm(); }

class Newton final : public Iteration {
 public:
  Newton(const Problem& problem, const NewtonSettings& settings)
      : problem_(problem),
        first_alpha_(settings.regularisation),
        function_(make_function(settings)),
        lambda_(mobility_per_row(problem)),
        system_(problem, settings.form),
        A_(problem),
        B_(problem),
        regularised_(problem),
        step_length_(settings.line_search),
        warmup_(settings.warmup) {
    if (warmup_ > 0) sweeps_ = make_gauss_seidel(problem);
  }

  void start(const Eigen::VectorXd& r) override {
    alpha_ = first_alpha_;
    step_length_.restart();
    warming_ = warmup_;
    if (sweeps_) sweeps_->start(r);
    move_to(r);
  }

  State advance() override {
    if (warming_ > 0) return warm_up();
    if (!find_direction()) return refuse();
    auto merit_at = [&](double t) {
      evaluate(p_ + t * dp_, u_ + t * du_, trial_);
      return half_square(trial_);
    };
    const double merit = half_square(phi_);
    const auto t = step_length_.find(merit_at, merit, slope_);
    if (!t) return refuse();
    move_to(r_ + *t * dr_);
    adapt_alpha(*t, half_square(phi_) < 0.9 * merit);
    return State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }

  double work_s() const override { return work_s_; }

  double own_eta() const override {
    return convex_error(problem_, de_saxce_shift(problem_, u_), r_, u_);
  }

 private:
  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }

  void move_to(const Eigen::VectorXd& r) {
    r_ = r;
    p_ = lambda_.cwiseProduct(r_);
    u_ = problem_.rate(r_);
    phi_.resize(r_.size());
    trial_.resize(r_.size());
    evaluate(p_, u_, phi_);
  }

  void evaluate(const Eigen::VectorXd& p, const Eigen::VectorXd& u, Eigen::VectorXd& phi) const {
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      function_->value(cone(i), p.segment(at, dim), u.segment(at, dim), phi.segment(at, dim));
    }
  }

  void linearise() {
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), dim = cone(i).dim;
      const double lambda = problem_.mobility()(i);
      function_->jacobian(cone(i), p_.segment(at, dim), u_.segment(at, dim), A_[i], B_[i]);
      A_[i] *= lambda;
      regularised_[i] = A_[i] + alpha_ * lambda * B_[i];
    }
  }

  // False when the matrix is singular or the direction is not one of descent.
  bool find_direction() {
    linearise();
    const bool factorised = system_.factorize(regularised_, B_);
    work_s_ += system_.work_s() + kSecondsPerRow * static_cast<double>(problem_.rows());
    if (!factorised) return false;
    dr_ = system_.solve(-phi_);
    dp_ = lambda_.cwiseProduct(dr_);
    du_ = problem_.apply_delassus(dr_) + alpha_ * dp_;
    slope_ = phi_.dot(A_ * dr_ + B_ * du_);
    return slope_ < 0.0;  // false for a NaN too
  }

  State warm_up() {
    const State state = sweeps_->advance();
    warming_ = state == State::kRunning ? warming_ - 1 : 0;
    move_to(sweeps_->r());
    return State::kRunning;
  }

  State refuse() {
    if (alpha_ >= kLargestAlpha) return State::kStalled;
    alpha_ = std::clamp(kGrowth * alpha_, 1e-12, kLargestAlpha);
    return State::kRunning;
  }

  void adapt_alpha(double t, bool merit_fell) {
    if (t < kShort) {
      alpha_ = std::min(kGrowth * alpha_, kLargestAlpha);
    } else if (t >= kWhole && alpha_ > kLeastAlpha) {
      alpha_ = std::max((merit_fell ? kFastDecay : kDecay) * alpha_, kLeastAlpha);
    }
  }

  const Problem& problem_;
  double first_alpha_;
  std::unique_ptr<const ConeFunction> function_;
  Eigen::VectorXd lambda_;  // one entry a row
  GeneralSystem system_;
  BlockDiagonal A_, B_, regularised_;  // the last: A + alpha B lambda
  StepLength step_length_;
  std::int64_t warmup_, warming_ = 0;  // sweeps of Gauss-Seidel; those still to come
  std::unique_ptr<Iteration> sweeps_;  // null without warm-up
  double alpha_ = 0.0, work_s_ = 0.0;
  Eigen::VectorXd r_, p_, u_, phi_;  // at the iterate; p = lambda r
  Eigen::VectorXd dr_, dp_, du_;     // along the step; du of the proximal problem
  double slope_ = 0.0;
  Eigen::VectorXd trial_;
};

}  // namespace

std::unique_ptr<Iteration> make_newton(const Problem& problem, const NewtonSettings& settings) {
  return std::make_unique<Newton>(problem, settings);
}

}  // namespace conebench::solvers
