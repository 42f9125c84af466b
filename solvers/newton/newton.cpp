#include "solvers/newton/newton.h"

#include <algorithm>

#include "solvers/convex.h"
#include "solvers/gs.h"
#include "solvers/newton/proximal_equation.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kLeastAlpha = 1e-10, kLargestAlpha = 100.0;
constexpr double kGrowth = 10.0;
// Below kShort the model failed; from kWhole on it held.
constexpr double kShort = 0.25, kWhole = 0.5;
// After a whole step; the first if the merit fell by more than a tenth.
constexpr double kFastDecay = 0.3, kDecay = 0.5;

class Newton final : public Iteration {
 public:
  Newton(const Problem& problem, const NewtonSettings& settings)
      : problem_(problem),
        first_alpha_(settings.regularisation),
        equation_(problem, settings),
        step_length_(settings.line_search),
        warmup_(settings.warmup) {
    if (warmup_ > 0) sweeps_ = make_gauss_seidel(problem);
  }

  void start(const Eigen::VectorXd& r) override {
    alpha_ = first_alpha_;
    step_length_.restart();
    warming_ = warmup_;
    if (sweeps_) sweeps_->start(r);
    equation_.start(r, alpha_);
  }

  State advance() override {
    if (warming_ > 0) return warm_up();
    const double merit = equation_.merit();
    const auto t = equation_.step(step_length_);
    work_s_ += equation_.step_work_s();
    if (!t) return refuse();
    equation_.recentre();
    adapt_alpha(*t, equation_.merit() < 0.9 * merit);
    return State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return equation_.r(); }

  double work_s() const override { return work_s_; }

  double own_eta() const override {
    return convex_error(problem_, de_saxce_shift(problem_, equation_.u()), equation_.r(),
                        equation_.u());
  }

 private:
  State warm_up() {
    const State state = sweeps_->advance();
    warming_ = state == State::kRunning ? warming_ - 1 : 0;
    equation_.start(sweeps_->r(), alpha_);
    return State::kRunning;
  }

  State refuse() {
    if (alpha_ >= kLargestAlpha) return State::kStalled;
    alpha_ = std::clamp(kGrowth * alpha_, 1e-12, kLargestAlpha);
    equation_.set_alpha(alpha_);
    return State::kRunning;
  }

  void adapt_alpha(double t, bool merit_fell) {
    if (t < kShort) {
      alpha_ = std::min(kGrowth * alpha_, kLargestAlpha);
    } else if (t >= kWhole && alpha_ > kLeastAlpha) {
      alpha_ = std::max((merit_fell ? kFastDecay : kDecay) * alpha_, kLeastAlpha);
    }
    equation_.set_alpha(alpha_);
  }

  const Problem& problem_;
  double first_alpha_;
  ProximalEquation equation_;
  StepLength step_length_;
  std::int64_t warmup_, warming_ = 0;  // sweeps of Gauss-Seidel; those still to come
  std::unique_ptr<Iteration> sweeps_;  // null without warm-up
  double alpha_ = 0.0, work_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Iteration> make_newton(const Problem& problem, const NewtonSettings& settings) {
  return std::make_unique<Newton>(problem, settings);
}

}  // namespace conebench::solvers
