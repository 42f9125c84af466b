#include "solvers/uzawa.h"

#include <algorithm>
#include <cmath>

#include "solvers/cone_vectors.h"
#include "solvers/convex.h"
#include "solvers/delassus_product.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

// rho |u_hat(r+) - u_hat(r)| / |r+ - r|: above the first, rho is too large; below the second, it
// may grow.
constexpr double kTooLarge = 1.2, kSmall = 0.9;
constexpr double kSafety = 0.9, kLargestCut = 0.2, kGrowth = 1.2;  // of rho
constexpr double kLargest = 1e6;                                   // rho
constexpr int kTrials = 60;                                        // of one step

class Uzawa final : public Iteration {
 public:
  explicit Uzawa(const Problem& problem)
      : problem_(problem), product_(problem), mobility_(mobility_per_row(problem)) {}

  void start(const Eigen::VectorXd& r) override {
    r_ = r;
    project_on_cones(problem_, r_);
    evaluate(r_, u_hat_);
    rho_ = 1.0;
  }

  State advance() override {
    const double ratio = step();
    if (!next_.allFinite()) return State::kDiverged;
    const double moved = size_as_rate(problem_, way_);
    r_.swap(next_);
    u_hat_.swap(u_hat_next_);
    if (ratio < kSmall) rho_ = std::min(kGrowth * rho_, kLargest);
    return moved <= kNoProgress * size_as_rate(problem_, r_) ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  double own_eta() const override {
    // u_hat is u with its shift already in it.
    return convex_error(problem_, Eigen::VectorXd::Zero(problem_.cone_count()), r_, u_hat_);
  }

 private:
  void evaluate(const Eigen::VectorXd& r, Eigen::VectorXd& u_hat) {
    product_.rate(r, u_hat);
    add_de_saxce(problem_, u_hat);
  }

  bool too_small_to_measure() const {
    return size_as_rate(problem_, way_) <= kTooSmallToMeasure * size_as_rate(problem_, r_);
  }

  // r+ and u_hat(r+); the ratio that rho is judged by, 0 where r+ = r.
  double step() {
    double ratio = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      next_ = r_ - rho_ * u_hat_.cwiseQuotient(mobility_);
      project_on_cones(problem_, next_);
      evaluate(next_, u_hat_next_);
      way_ = next_ - r_;
      const double length = way_.cwiseAbs2().dot(mobility_);
      if (length == 0.0) return 0.0;
      const double turn = (u_hat_next_ - u_hat_).cwiseAbs2().cwiseQuotient(mobility_).sum();
      ratio = rho_ * std::sqrt(turn / length);
      if (!(ratio > kTooLarge) || too_small_to_measure()) break;
      rho_ *= std::max(kLargestCut, kSafety * kTooLarge / ratio);
    }
    return ratio;
  }

  const Problem& problem_;
  DelassusProduct product_;
  Eigen::VectorXd mobility_;  // lambda_i on each row of cone i
  Eigen::VectorXd r_, u_hat_, next_, u_hat_next_, way_;
  double rho_ = 1.0;
};

}  // namespace

Method uzawa() {
  Method method{
      .name = "uzawa",
      .kind = Kind::kMethod,
      .summary = "Uzawa's algorithm on the bipotential, all contacts at once",
      .source =
          "De Saxce, Feng, Int. J. Mech. Struct. Mach. 19(3) (1991); Math. Comput. Modelling 28 "
          "(1998); Joli, Feng, Int. J. Numer. Meth. Engng 73 (2008) 317-330; the test on rho: "
          "Khobotov, USSR Comput. Math. Math. Phys. 27 (1987) (none checked)",
      .parameters = {},
      .make = {}};
  method.make = [method](const Values& values) {
    return make_iterative_solver(method, values, refuse_zero_delassus, [](const Problem& problem) {
      return std::make_unique<Uzawa>(problem);
    });
  };
  return method;
}

}  // namespace conebench::solvers
