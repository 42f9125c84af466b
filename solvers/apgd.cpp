#include "solvers/apgd.h"

#include <algorithm>
#include <cmath>

#include "solvers/cone_vectors.h"
#include "solvers/convex.h"
#include "solvers/delassus_product.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kGrowth = 2.0, kShrinkage = 0.98;  // of L
constexpr double kLeast = 1e-6;                     // L
constexpr int kTrials = 60;                         // of one step
// Of a product with W, both ways, and of what else an iteration does (work_s).
constexpr double kSecondsPerEntry = 2e-9, kSecondsPerRow = 1e-8;

class Apgd final : public Iteration {
 public:
  Apgd(const Problem& problem, std::int64_t refresh)
      : problem_(problem),
        refresh_(refresh),
        product_(problem),
        entries_(static_cast<double>((problem.is_primal() ? problem.H() : problem.W()).nonZeros())),
        mobility_(mobility_per_row(problem)) {}

  void start(const Eigen::VectorXd& r) override {
    r_ = r;
    project_on_cones(problem_, r_);
    product_.rate(r_, u_);
    y_ = r_;
    u_y_ = u_;
    L_ = 1.0;
    weight_ = 1.0;
    iterations_ = 0;
  }

  State advance() override {
    const bool fresh = iterations_++ % refresh_ == 0;
    refresh_gradient(fresh);
    step_from_y();
    way_ = next_ - r_;
    step_ = next_ - y_;
    const double moved = std::max(size_as_rate(problem_, way_), size_as_rate(problem_, step_));
    const double beta = next_beta();
    y_ = next_ + beta * way_;
    u_y_ = u_next_ + beta * (u_next_ - u_);
    r_.swap(next_);
    u_.swap(u_next_);
    L_ = std::max(kShrinkage * L_, kLeast);
    if (!r_.allFinite()) return State::kDiverged;
    return fresh && moved <= kNoProgress * size_as_rate(problem_, r_) ? State::kStalled
                                                                      : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  double own_eta() const override {
    return convex_error(problem_, de_saxce_shift(problem_, u_), r_, u_);
  }
  double work_s() const override { return work_s_; }

 private:
  // u_hat at y, with t of now or of the last time.
  void refresh_gradient(bool fresh) {
    if (fresh) {
      gradient_ = u_y_;
      add_de_saxce(problem_, gradient_);
      shift_ = gradient_ - u_y_;
    } else {
      gradient_ = u_y_ + shift_;
    }
  }

  void step_from_y() {
    for (int trial = 0; trial < kTrials; ++trial) {
      next_ = y_ - gradient_.cwiseQuotient(mobility_) / L_;
      project_on_cones(problem_, next_);
      product_.rate(next_, u_next_);
      work_s_ += kSecondsPerEntry * entries_ + kSecondsPerRow * static_cast<double>(r_.size());
      step_ = next_ - y_;
      const double curvature = step_.dot(u_next_ - u_y_);
      if (!(curvature > L_ * step_.cwiseAbs2().dot(mobility_)) || too_small_to_measure()) return;
      L_ *= kGrowth;
    }
  }

  bool too_small_to_measure() const {
    return size_as_rate(problem_, step_) <= kTooSmallToMeasure * size_as_rate(problem_, next_);
  }

  // beta of weight_ = w: w (1 - w) / (w^2 + w+), where w+^2 = (1 - w+) w^2.
  double next_beta() {
    if (step_.cwiseProduct(mobility_).dot(way_) < 0.0) {
      weight_ = 1.0;
      return 0.0;
    }
    const double square = weight_ * weight_;
    const double next = 0.5 * (std::sqrt(square * square + 4.0 * square) - square);
    const double beta = weight_ * (1.0 - weight_) / (square + next);
    weight_ = next;
    return beta;
  }

  const Problem& problem_;
  std::int64_t refresh_;
  DelassusProduct product_;
  double entries_;  // of H, or of W where there is none
  double work_s_ = 0.0;
  Eigen::VectorXd mobility_;          // lambda_i on each row of cone i
  Eigen::VectorXd r_, u_, y_, u_y_;   // u at r, at y
  Eigen::VectorXd gradient_, shift_;  // at y; t e_n
  Eigen::VectorXd next_, u_next_;     // r+, u at it
  Eigen::VectorXd way_, step_;        // r+ - r, r+ - y
  double L_ = 1.0, weight_ = 1.0;
  std::int64_t iterations_ = 0;
};

Solver make(const Method& method, const Values& values) {
  const std::int64_t refresh = std::get<std::int64_t>(values.at("refresh"));
  return make_iterative_solver(
      method, values, refuse_zero_delassus,
      [refresh](const Problem& problem) { return std::make_unique<Apgd>(problem, refresh); });
}

}  // namespace

std::unique_ptr<Iteration> make_apgd(const Problem& problem) {
  return std::make_unique<Apgd>(problem, 1);
}

Method apgd() {
  Method method{
      .name = "apgd",
      .kind = Kind::kMethod,
      .summary = "accelerated projected gradient, restarted, De Saxce term refreshed",
      .source =
          "Mazhar, Heyn, Negrut, Tasora, ACM Trans. Graph. 34(3) (2015), Algorithm 1; restart: "
          "O'Donoghue, Candes, Found. Comput. Math. 15 (2015) (neither checked)",
      .parameters = {{.name = "refresh",
                      .fallback = std::int64_t{1},
                      .low = 1,
                      .high = 10000,
                      .doc = "iterations between two refreshes of the De Saxce term [-]"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
