#include "solvers/extragradient.h"

#include <algorithm>
#include <cmath>

#include "solvers/cone_vectors.h"
#include "solvers/convex.h"
#include "solvers/delassus_product.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

// tau |F(r) - F(p)| / |r - p|: above the first, tau is too long; below the second, it may grow.
constexpr double kTooLong = 0.9, kShort = 0.3;
constexpr double kShortening = 2.0 / 3.0, kGrowth = 1.5;  // of tau
constexpr double kLongest = 1e6;                          // tau
constexpr int kTrials = 60;                               // of one prediction
constexpr double kGamma = 1.8;                            // of the optimal step, in [1, 2)

class Extragradient final : public Iteration {
 public:
  Extragradient(const Problem& problem, bool optimal_step)
      : problem_(problem),
        optimal_step_(optimal_step),
        product_(problem),
        mobility_(mobility_per_row(problem)) {}

  void start(const Eigen::VectorXd& r) override {
    r_ = r;
    project_on_cones(problem_, r_);
    evaluate(r_, F_);
    tau_ = 1.0;
  }

  State advance() override {
    const double ratio = predict();
    const bool measured = !too_small_to_measure();  // else ratio is rounding
    const double length = tau_ * (optimal_step_ && measured ? optimal_step() : 1.0);
    next_ = r_ - length * F_p_.cwiseQuotient(mobility_);
    project_on_cones(problem_, next_);
    if (!next_.allFinite()) return State::kDiverged;
    const double predicted = size_as_rate(problem_, back_);
    back_ = r_ - next_;
    const double moved = std::max(predicted, size_as_rate(problem_, back_));
    r_.swap(next_);
    evaluate(r_, F_);
    if (ratio < kShort && measured) tau_ = std::min(kGrowth * tau_, kLongest);
    return moved <= kNoProgress * size_as_rate(problem_, r_) ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  double own_eta() const override {
    // F is u with its shift already in it.
    return convex_error(problem_, Eigen::VectorXd::Zero(problem_.cone_count()), r_, F_);
  }

 private:
  void evaluate(const Eigen::VectorXd& r, Eigen::VectorXd& F) {
    product_.rate(r, F);
    add_de_saxce(problem_, F);
  }

  bool too_small_to_measure() const {
    return size_as_rate(problem_, back_) <= kTooSmallToMeasure * size_as_rate(problem_, r_);
  }

  // p, F(p), back = r - p, turn = F(r) - F(p); tau |turn| / |back|, 0 where p = r.
  double predict() {
    double ratio = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      p_ = r_ - tau_ * F_.cwiseQuotient(mobility_);
      project_on_cones(problem_, p_);
      evaluate(p_, F_p_);
      back_ = r_ - p_;
      turn_ = F_ - F_p_;
      const double way = back_.cwiseAbs2().dot(mobility_);
      if (way == 0.0) return 0.0;
      ratio = tau_ * std::sqrt(turn_.cwiseAbs2().cwiseQuotient(mobility_).sum() / way);
      if (!(ratio > kTooLong) || too_small_to_measure()) break;
      tau_ *= kShortening * std::min(1.0, 1.0 / ratio);
    }
    return ratio;
  }

  // gamma s.
  double optimal_step() {
    d_ = back_.cwiseProduct(mobility_) - tau_ * turn_;
    const double square = d_.cwiseAbs2().cwiseQuotient(mobility_).sum();
    return square > 0.0 ? kGamma * back_.dot(d_) / square : 1.0;
  }

  const Problem& problem_;
  bool optimal_step_;
  DelassusProduct product_;
  Eigen::VectorXd mobility_;  // lambda_i on each row of cone i
  Eigen::VectorXd r_, F_, p_, F_p_, next_;
  Eigen::VectorXd back_, turn_, d_;
  double tau_ = 1.0;
};

Solver make(const Method& method, const Values& values) {
  const bool optimal = std::get<std::string>(values.at("step")) == "optimal";
  return make_iterative_solver(method, values, refuse_zero_delassus,
                               [optimal](const Problem& problem) {
                                 return std::make_unique<Extragradient>(problem, optimal);
                               });
}

}  // namespace

Method extragradient() {
  Method method{
      .name = "extragradient",
      .kind = Kind::kMethod,
      .summary = "extragradient on the Coulomb problem itself, step length adapted",
      .source =
          "Korpelevich, Matekon 13 (1977); step length: Khobotov, USSR Comput. Math. Math. Phys. "
          "27 (1987), Marcotte, INFOR 29 (1991); correction: He, Liao, J. Optim. Theory Appl. 112 "
          "(2002) (none checked)",
      .parameters = {{.name = "step",
                      .fallback = std::string("optimal"),
                      .choices = {"optimal", "unit"},
                      .doc = "length of the correction: He and Liao's, or Korpelevich's"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
